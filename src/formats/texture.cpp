#include "formats/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/read_file.h"
#include "formats/file_kinds.h"
#include "formats/png_picture.h"
#include "formats/scene_file.h"

namespace hooke {
namespace {

constexpr std::array texture_rows{
    ShippedTexture{"checker", "Checker", 0.25},
    ShippedTexture{"linen", "Linen", 0.16},
    ShippedTexture{"tartan", "Tartan", 0.36},
};

const ShippedTexture* find_shipped(std::string_view texture) {
  const auto row = std::ranges::find(texture_rows, texture, &ShippedTexture::id);
  return row == texture_rows.end() ? nullptr : &*row;
}

// The axes right and down in the mean plane of the faces, as seen from the initial viewpoint.
struct Axes {
  Vec3 right, down;
};
Axes axes_of_faces(const System& system, const State& state) {
  Vec3 normal(0.0);
  for (const Face& face : system.faces) {
    const auto corner = [&](int c) { return state.position[system.index_of(face.points[c])]; };
    normal += glm::cross(corner(1) - corner(0), corner(2) - corner(0));
  }
  const double length = glm::length(normal);
  normal = length > 0.0 && std::isfinite(length) ? normal / length : Vec3(0.0, 0.0, 1.0);
  if (glm::dot(normal, Vec3(0.2, 0.5, 1.0)) < 0.0) normal = -normal;

  const double gravity_magnitude = glm::length(system.gravity);
  Vec3 down = gravity_magnitude > 0.0 ? system.gravity / gravity_magnitude : Vec3(0.0, -1.0, 0.0);
  if (std::abs(glm::dot(down, normal)) > 0.9) down = std::abs(normal.z) > 0.9 ? Vec3(0.0, -1.0, 0.0) : Vec3(0.0, 0.0, 1.0);
  down = glm::normalize(down - glm::dot(down, normal) * normal);
  return {-glm::cross(down, normal), down};
}

bool has_place(const glm::dvec2& place) { return std::isfinite(place.x) && std::isfinite(place.y); }

void assign_missing_places(Scene& scene) {
  const System& system = scene.system;
  const auto lacks = [&](PointId id) { return !has_place(cloth_coordinates_of(scene.cloth_texture, id)); };
  const bool any = std::ranges::any_of(system.faces, [&](const Face& face) { return std::ranges::any_of(face.points, lacks); });
  if (!any) return;

  auto cloth_coordinates = std::make_shared<ClothCoordinates>(scene.cloth_texture.cloth_coordinates ? *scene.cloth_texture.cloth_coordinates
                                                                                                    : ClothCoordinates());
  cloth_coordinates->resize(system.next_point_id(), no_cloth_coordinates);
  const Axes axes = axes_of_faces(system, scene.state);
  const Vec3 origin =
      scene.state.position[system.index_of(system.faces.front().points[0])];  // far from the first point, coordinates have low precision
  for (const Face& face : system.faces)
    for (const PointId id : face.points) {
      glm::dvec2& place = (*cloth_coordinates)[static_cast<std::size_t>(id)];
      if (has_place(place)) continue;
      const Vec3 at = scene.state.position[system.index_of(id)] - origin;
      place = {glm::dot(at, axes.right), glm::dot(at, axes.down)};
      // positions near the largest number have no finite difference
      if (!has_place(place)) place = no_cloth_coordinates;
    }
  scene.cloth_texture.cloth_coordinates = std::move(cloth_coordinates);
}

// [m], the horizontal extent; 1 if it cannot be determined.
double width_of_coordinates(const ClothTexture& cloth_texture) {
  double min = INFINITY, max = -INFINITY;
  if (cloth_texture.cloth_coordinates)
    for (const glm::dvec2& place : *cloth_texture.cloth_coordinates) {
      if (!has_place(place)) continue;
      min = std::min(min, place.x);
      max = std::max(max, place.x);
    }
  return max > min && std::isfinite(max - min) ? max - min : 1.0;
}

}  // namespace

std::span<const ShippedTexture> shipped_textures() { return texture_rows; }
bool is_shipped_texture(std::string_view id) { return find_shipped(id) != nullptr; }

std::string texture_limit(std::string_view texture) {
  if (texture.empty() || find_shipped(texture) != nullptr) return {};
  if (find_file_kind(texture) != &png_file) {
    std::string ids;
    for (const ShippedTexture& row : texture_rows) ids += std::string(row.id) + ", ";
    return "must be " + ids + "or a .png in the folder of the scene";
  }
  const std::filesystem::path path = std::filesystem::path(texture).lexically_normal();
  const bool has_no_control_characters = std::ranges::none_of(texture, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  const bool is_inside_folder = !path.is_absolute() && !path.empty() && *path.begin() != "..";
  return has_no_control_characters && is_inside_folder ? "" : "must be in the folder of the scene";
}

std::shared_ptr<const Picture> read_texture(const std::string& texture, const std::filesystem::path& folder, const std::string& name) {
  if (find_shipped(texture) == nullptr) return std::make_shared<const Picture>(decode_png(read_file_within(folder, texture, name), name));
  const std::filesystem::path shipped = assets_folder() / "textures";
  return std::make_shared<const Picture>(decode_png(read_file(shipped / (texture + ".png")), name));
}

void set_print_layout(Scene& scene) {
  if (scene.view.texture.empty()) return;
  assign_missing_places(scene);
  const ShippedTexture* shipped = find_shipped(scene.view.texture);
  scene.cloth_texture.width =
      scene.view.texture_size.value_or(shipped != nullptr ? shipped->width : width_of_coordinates(scene.cloth_texture));
}

}  // namespace hooke
