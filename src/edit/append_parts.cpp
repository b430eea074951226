#include "edit/append_parts.h"

#include "base/errors.h"
#include "base/file_limits.h"
#include "edit/command.h"
#include "formats/scene_file.h"
#include "scene/parameters.h"

namespace hooke {
namespace {

void check_count(const char* what, std::size_t count, std::uint64_t max) {
  if (count > max) throw InputError(std::string(what) + ": " + std::to_string(count) + ": must be at most " + std::to_string(max));
}

// "[a]" and "[b]": "[a, b]"; of an empty text the other one.
std::string joined(const std::string& first, const std::string& second) {
  if (first.empty() || second.empty()) return first + second;
  return first.substr(0, first.rfind(']')) + ", " + second.substr(second.find('[') + 1);
}

ClothCoordinates joined(const Scene& scene, const Scene& part) {
  ClothCoordinates all;
  if (scene.cloth_texture.cloth_coordinates) all = *scene.cloth_texture.cloth_coordinates;
  all.resize(scene.system.points().size(), no_cloth_coordinates);
  all.insert(all.end(), part.cloth_texture.cloth_coordinates->begin(), part.cloth_texture.cloth_coordinates->end());
  return all;
}

}  // namespace

void append_parts(Scene& scene, const Scene& part) {
  check_count("points", scene.system.points().size() + part.system.points().size(), max_points);
  check_count("springs", scene.system.springs().size() + part.system.springs().size(), max_springs);
  check_count("faces", scene.system.faces.size() + part.system.faces.size(), max_faces);
  check_count("colliders", scene.system.colliders.size() + part.system.colliders.size(), max_colliders);
  check_count("forces", scene.system.forces.size() + part.system.forces.size(), max_forces);
  if (scene.system.dimensions == 2 && part.system.dimensions == 3) throw InputError("dimensions: 3: must be 2, as in the scene");

  if (part.cloth_texture.cloth_coordinates)
    scene.cloth_texture.cloth_coordinates = std::make_shared<const ClothCoordinates>(joined(scene, part));

  // the ids of the part, shifted to unused ones
  const std::uint32_t first_point = scene.system.next_point_id(), first_spring = scene.system.next_spring_id();
  const auto shifted = [&](PointId id) { return PointId{static_cast<std::uint32_t>(id) + first_point}; };
  Insert insert;
  for (Index i = 0; i < part.system.point_count(); ++i) {
    Point point = part.system.points()[i];
    const double area = area_of(part.sheet.get(), point.id);
    point.id = shifted(point.id);
    insert.points.push_back({.point = point, .position = part.state.position[i], .velocity = part.state.velocity[i], .area = area});
  }
  for (Spring spring : part.system.springs()) {
    const double weight = sheet_weight_of(part.sheet.get(), spring.id);
    spring.id = SpringId{static_cast<std::uint32_t>(spring.id) + first_spring};
    spring.first = shifted(spring.first);
    spring.second = shifted(spring.second);
    insert.springs.push_back({.spring = spring, .sheet_weight = weight});
  }
  for (Face face : part.system.faces) {
    for (PointId& corner : face.points) corner = shifted(corner);
    insert.faces.push_back({.face = face});
  }
  Effect effect;
  if (!insert.points.empty()) {
    apply(scene, insert, effect);
    // generators come last in a file: those of the scene stay generators if the part consists of nothing else
    scene.preserved_json.generators = joined(scene.preserved_json.generators, part.preserved_json.generators);
  }

  SetColliders colliders{scene.system.colliders};
  colliders.colliders.insert(colliders.colliders.end(), part.system.colliders.begin(), part.system.colliders.end());
  if (!part.system.colliders.empty()) apply(scene, colliders, effect);
  SetForces forces{scene.system.forces};
  forces.forces.insert(forces.forces.end(), part.system.forces.begin(), part.system.forces.end());
  if (!part.system.forces.empty()) apply(scene, forces, effect);
}

void add_members(Scene& scene, std::string_view members, const std::string& name) {
  const Scene part = parse_members(members, name, scene);
  append_parts(scene, part);
  copy_surroundings(part, scene);
}

}  // namespace hooke
