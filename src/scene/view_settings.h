// The view settings of a scene: stored with the document, read by draw.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/model/system.h"

namespace hooke {

struct CameraPose {
  Vec3 eye{0.0, 0.0, 3.0};
  Vec3 target{0.0};
  std::optional<Vec3> up;  // none: opposite to gravity (y without gravity)
  bool orthographic = false;
  bool follows = false;  // follows the center of all points when it leaves the middle of the picture
  bool operator==(const CameraPose&) const = default;
};

struct ViewSettings {
  std::optional<CameraPose> camera;  // none: frames the scene
  std::optional<Color> background;   // none: the default of the program
  // visible parts of the network; strain colors are shown on the springs, or on the surface if springs are hidden
  bool surface = true, springs = true, points = true, strain_colors = true;
  bool coils = false;                  // springs are drawn as coils
  bool shadows = true;                 // near the ground, a sphere or a box
  std::string texture;                 // on the faces: a shipped texture, or a PNG in the folder of the scene; empty: none
  std::optional<double> texture_size;  // [m], width of the image on the cloth, > 0; none: the default of the texture
  std::vector<std::string> plots;      // names of quantities (quantity.h); empty: those of the program
  bool operator==(const ViewSettings&) const = default;
};

// Of settings, or of the options of a picture (draw/view.h).
void copy_visible_parts(const auto& from, auto& to) {
  to.surface = from.surface;
  to.springs = from.springs;
  to.points = from.points;
  to.strain_colors = from.strain_colors;
  to.coils = from.coils;
  to.shadows = from.shadows;
}

// RGB or RGBA, 8 bits, rows from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
  int channels = 3;
};

// [m] on the flat cloth, right and down from its first corner, of each point by its id; NaN: not on a cloth, as for all ids beyond the end.
using ClothCoordinates = std::vector<glm::dvec2>;
inline constexpr glm::dvec2 no_cloth_coordinates{std::numeric_limits<double>::quiet_NaN()};

// The texture of the faces, ready to be drawn.
struct ClothTexture {
  std::shared_ptr<const Picture> picture;                     // null: none
  std::shared_ptr<const ClothCoordinates> cloth_coordinates;  // null: no point has one
  double width = 1.0;                                         // [m], width of the picture on the cloth; it repeats
};

// [m], NaN if the point has none.
inline glm::dvec2 cloth_coordinates_of(const ClothTexture& cloth_texture, PointId id) {
  const auto at = static_cast<std::size_t>(id);
  return cloth_texture.cloth_coordinates && at < cloth_texture.cloth_coordinates->size() ? (*cloth_texture.cloth_coordinates)[at]
                                                                                         : no_cloth_coordinates;
}

}  // namespace hooke
