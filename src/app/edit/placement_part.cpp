#include "app/edit/placement_part.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/file_limits.h"
#include "base/printable.h"
#include "formats/mesh/mesh_cloth.h"
#include "formats/open_file.h"
#include "scene/shape.h"
#include "sim/plan/hinges.h"

namespace hooke {
namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;  // [rad]

Box box_around(const std::vector<Vec3>& places) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Box box{Vec3(far), Vec3(-far)};
  for (const Vec3& place : places) {
    box.min = glm::min(box.min, place);
    box.max = glm::max(box.max, place);
  }
  return box;
}

// x rotated about the unit axis n by an angle [rad] (Rodrigues 1840).
Vec3 rotated(const Vec3& x, const Vec3& n, double angle) {
  return std::cos(angle) * x + std::sin(angle) * glm::cross(n, x) + (1.0 - std::cos(angle)) * glm::dot(n, x) * n;
}

// Rotates from coordinates with y up to coordinates with `up` up.
Vec3 uprighted(const Vec3& x, const Vec3& up) {
  const Vec3 y(0.0, 1.0, 0.0), axis = glm::cross(y, up);
  const double sine = glm::length(axis), cosine = glm::dot(y, up);
  if (sine > 1e-9) return rotated(x, axis / sine, std::atan2(sine, cosine));
  return cosine > 0.0 ? x : Vec3(x.x, -x.y, -x.z);
}

Scene from_network(Network network) {
  Scene scene;
  scene.system.set_points(std::move(network.points));
  scene.system.set_springs(std::move(network.springs));
  scene.system.faces = std::move(network.faces);
  scene.state.position = std::move(network.position);
  scene.state.velocity = std::move(network.velocity);
  scene.sheet = std::make_shared<const SheetWeights>(SheetWeights{std::move(network.sheet_areas), std::move(network.sheet_weights)});
  return scene;
}

// Lengths scale with the size, masses with the area; the stiffness of a sheet does not depend on its size.
Scene scaled(Scene scene, double size) {
  for (Vec3& place : scene.state.position) place *= size;
  for (Index i = 0; i < scene.system.point_count(); ++i) {
    scene.system.point(i).mass *= size * size;
    scene.system.point(i).radius *= size;
  }
  for (Index s = 0; s < scene.system.spring_count(); ++s) scene.system.spring(s)->rest_length *= size;
  if (scene.sheet) {
    SheetWeights sheet = *scene.sheet;
    for (std::size_t i = 0; i < sheet.area.size(); ++i) sheet.area.set(i, sheet.area[i] * (size * size));
    scene.sheet = std::make_shared<const SheetWeights>(std::move(sheet));
  }
  return scene;
}

// The mass and springs of a sheet of this material.
void set_material(Scene& part, const SheetMaterial& material) {
  for (Index i = 0; i < part.system.point_count(); ++i)
    if (const double area = area_of(part.sheet.get(), part.system.points()[i].id); area > 0.0)
      part.system.point(i).mass = material.density * area;
  for (Index s = 0; s < part.system.spring_count(); ++s) {
    const double weight = sheet_weight_of(part.sheet.get(), part.system.springs()[s].id);
    part.system.spring(s)->stiffness = material.stiffness * weight;
    part.system.spring(s)->damping = material.damping * weight;
  }
}

void turn(Scene& part, double turn_degrees, double tilt_degrees) {
  for (Vec3& place : part.state.position)
    place = rotated(rotated(place, {1.0, 0.0, 0.0}, tilt_degrees * degree), {0.0, 1.0, 0.0}, turn_degrees * degree);
}

}  // namespace

MeshPart load_mesh_part(const std::filesystem::path& file, const Progress& progress) {
  try {
    const FileKind* kind = find_readable_kind(file);
    if (kind == nullptr || !kind->is_mesh) return {nullptr, printable(file.native()) + ": must be an .obj file"};
    Scene scene = load_file(file, progress).scene;
    const Box box = box_around(scene.state.position);
    const Vec3 size = box.max - box.min;
    const double longest = std::max({size.x, size.y, size.z});
    for (Vec3& place : scene.state.position) place -= 0.5 * (box.min + box.max);
    return {std::make_shared<const Scene>(scaled(std::move(scene), 1.0 / longest)), {}};
  } catch (const std::runtime_error& refusal) {  // InputError or FileError
    return {nullptr, refusal.what()};
  }
}

Scene part_of(const Placement& placement, const Scene* mesh, const Vec3& up, bool is_flat) {
  Scene part;
  if (placement.is_mesh) {
    if (mesh == nullptr) return part;
    part = scaled(*mesh, placement.mesh_size);
    set_material(part, {placement.mesh_density, placement.mesh_stiffness, placement.mesh_damping});
    for (Index i = 0; placement.is_obstacle && i < part.system.point_count(); ++i) part.system.point(i).nailed = true;
    if (!is_flat) turn(part, placement.shape.turn, placement.shape.tilt);
  } else {
    Shape shape = placement.shape;
    shape.at = Vec3(0.0);
    if (is_flat) {
      shape.turn = shape.tilt = 0.0;
      for (std::size_t i = 0; i < shape.kind->numbers.size(); ++i)
        if (shape.kind->numbers[i].is_3d_only) shape.values[i] = 0.0;
    }
    const ElementCount element_count = element_count_of(shape);
    if (element_count.points > max_points || element_count.springs > max_springs) return part;
    Network network;
    generate(shape, network);
    part = from_network(std::move(network));
  }
  for (Vec3& place : part.state.position) place = placement.shape.at + (is_flat ? place : uprighted(place, up));
  if (!is_flat) set_rest_angles(part.system, part.state.position);
  return part;
}

std::optional<PairContact> contact_of(const Placement& placement, const Scene& part, bool is_flat) {
  const ShapeContact touching = placement.is_mesh ? ShapeContact::Faces : placement.shape.kind->contact;
  if (touching == ShapeContact::None || (is_flat && touching == ShapeContact::Faces) || part.system.springs().empty()) return std::nullopt;
  // a fifth of the distance of its points: neighbors do not touch, and the gap between folds is not noticed
  constexpr double relative_thickness = 0.2, max_thickness = 0.02;
  std::vector<double> lengths;
  for (const Spring& spring : part.system.springs()) lengths.push_back(spring.rest_length);
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  // faces as well where springs touch: whatever is added next touches too
  return PairContact{.springs = true, .faces = !is_flat, .thickness = std::min(relative_thickness * *middle, max_thickness)};
}

void mark_part(const Scene& part, Marks& marks) {
  // more lines would not be distinguishable; at equal distances in the list, they would show stripes
  constexpr std::size_t max_lines = 20'000;
  const System& system = part.system;
  const std::uint32_t every = 1 + static_cast<std::uint32_t>(system.springs().size() / max_lines);
  for (std::size_t s = 0; s < system.springs().size(); ++s) {
    if ((static_cast<std::uint32_t>(s) * 2654435769u >> 16) % every != 0) continue;  // Knuth's multiplicative hash
    const Spring& spring = system.springs()[s];
    marks.ghost_lines.emplace_back(part.state.position[system.index_of(spring.first)], part.state.position[system.index_of(spring.second)]);
  }
  for (Index i = 0; i < system.point_count(); ++i)
    if (system.points()[i].nailed) marks.ghost_nails.push_back(part.state.position[i]);
}

}  // namespace hooke
