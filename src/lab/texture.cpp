#include "lab/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "lab/png_picture.h"
#include "lab/read_file.h"
#include "lab/scene_file.h"

namespace hooke {
namespace {

constexpr std::array rows{
    ShippedTexture{"checker", "Checker", 0.25},
    ShippedTexture{"linen", "Linen", 0.16},
    ShippedTexture{"tartan", "Tartan", 0.36},
};

const ShippedTexture* find_shipped(std::string_view texture) {
  const auto row = std::ranges::find(rows, texture, &ShippedTexture::id);
  return row == rows.end() ? nullptr : &*row;
}

bool is_png(std::string_view texture) {
  constexpr std::string_view ending = ".png";
  return texture.size() > ending.size() && std::equal(ending.rbegin(), ending.rend(), texture.rbegin(), [](char a, char b) {
           return a == (b >= 'A' && b <= 'Z' ? static_cast<char>(b - 'A' + 'a') : b);
         });
}

// Right and down on the plane that the faces lie in on the whole, seen from the side that a person sees first.
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

  const double pull = glm::length(system.gravity);
  Vec3 down = pull > 0.0 ? system.gravity / pull : Vec3(0.0, -1.0, 0.0);
  if (std::abs(glm::dot(down, normal)) > 0.9) down = std::abs(normal.z) > 0.9 ? Vec3(0.0, -1.0, 0.0) : Vec3(0.0, 0.0, 1.0);
  down = glm::normalize(down - glm::dot(down, normal) * normal);
  return {-glm::cross(down, normal), down};
}

bool has_place(const glm::dvec2& place) { return std::isfinite(place.x) && std::isfinite(place.y); }

void place_corners(Scene& scene) {
  const System& system = scene.system;
  const auto lacks = [&](PointId id) { return !has_place(place_on_cloth(scene.print, id)); };
  const bool any = std::ranges::any_of(system.faces, [&](const Face& face) { return std::ranges::any_of(face.points, lacks); });
  if (!any) return;

  auto places = std::make_shared<ClothPlaces>(scene.print.places ? *scene.print.places : ClothPlaces());
  places->resize(system.next_point_id(), no_cloth_place);
  const Axes axes = axes_of_faces(system, scene.state);
  const Vec3 origin = scene.state.position[system.index_of(system.faces.front().points[0])];  // far from it numbers are coarse
  for (const Face& face : system.faces)
    for (const PointId id : face.points) {
      glm::dvec2& place = (*places)[static_cast<std::size_t>(id)];
      if (has_place(place)) continue;
      const Vec3 at = scene.state.position[system.index_of(id)] - origin;
      place = {glm::dot(at, axes.right), glm::dot(at, axes.down)};
    }
  scene.print.places = std::move(places);
}

// [m], from the first place to the last; 1 where there is nothing to measure.
double width_of_places(const Print& print) {
  double least = INFINITY, most = -INFINITY;
  if (print.places)
    for (const glm::dvec2& place : *print.places) {
      if (!has_place(place)) continue;
      least = std::min(least, place.x);
      most = std::max(most, place.x);
    }
  return most > least && std::isfinite(most - least) ? most - least : 1.0;
}

}  // namespace

std::span<const ShippedTexture> shipped_textures() { return rows; }

std::string texture_limit(std::string_view texture) {
  if (texture.empty() || find_shipped(texture) != nullptr) return {};
  if (!is_png(texture)) {
    std::string ids;
    for (const ShippedTexture& row : rows) ids += std::string(row.id) + ", ";
    return "must be " + ids + "or a .png in the scene's folder";
  }
  const std::filesystem::path way(texture);
  const bool is_plain = std::ranges::none_of(texture, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  const bool stays = !way.is_absolute() && std::ranges::none_of(way, [](const auto& step) { return step == ".." || step == "."; });
  return is_plain && stays ? "" : "must lie in the scene's folder";
}

std::shared_ptr<const Picture> read_texture(const std::string& texture, const std::filesystem::path& folder, const std::string& name) {
  if (find_shipped(texture) == nullptr) return std::make_shared<const Picture>(decode_png(read_file_within(folder, texture, name), name));
  const std::filesystem::path shipped = shipped_scenes().front().file.parent_path().parent_path() / "textures";
  return std::make_shared<const Picture>(decode_png(read_file(shipped / (texture + ".png")), name));
}

void lay_out_print(Scene& scene) {
  if (scene.view.texture.empty()) return;
  place_corners(scene);
  const ShippedTexture* shipped = find_shipped(scene.view.texture);
  scene.print.width = scene.view.texture_size.value_or(shipped != nullptr ? shipped->width : width_of_places(scene.print));
}

}  // namespace hooke
