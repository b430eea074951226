// The fraction of light from above that objects block at each position of a flat map; higher objects have softer shadows.
// Computed on the CPU, the same for every driver: no OpenGL.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace hooke {

class SoftShadowMap {
 public:
  // The light source is wide: a shadow is blurred by this length [m] per meter of height.
  static constexpr float softness = 0.4f;
  // The occlusion of a sheet or line seen edge-on.
  static constexpr float edge_on_occlusion = 0.35f;

  // Clears the map. It lies between `min` and `max` [m]; its longer side has this many square texels.
  void begin(const glm::vec2& min, const glm::vec2& max, int texels);
  int width() const { return width_; }
  int height() const { return height_; }
  float texel() const { return texel_; }  // [m]

  // Adds a small object of this area [m^2], seen from below, at a position on the map and a height [m]. Objects outside or below the
  // map are ignored.
  void add(const glm::vec3& place, float area);
  // Adds a line of this width [m], or a triangle. A triangle seen edge-on still blocks some light.
  void add_line(const glm::vec3& a, const glm::vec3& b, float width);
  void add_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

  // The occlusion from 0 to 255, row by row; 0 at the border of the map, so that no edge is visible.
  const std::vector<std::uint8_t>& finish();

 private:
  // Objects of similar height. Texels double in size from level to level; padding around the map receives the blur.
  struct Level {
    int width = 0, height = 0;
    std::vector<float> coverage;  // area of the objects relative to that of the texel
  };
  static constexpr int level_count = 6;
  static constexpr int padding = 2;

  void add_to(int level, const glm::vec2& at, float coverage);
  struct Width;
  Width width_at(float height) const;
  int steps_for(float length, float lowest) const;

  glm::vec2 min_{0.0f};
  float texel_ = 1.0f;
  int width_ = 0, height_ = 0;
  std::array<Level, level_count> levels_;
  std::vector<float> blurred_;
  std::vector<std::uint8_t> occlusion_;
};

}  // namespace hooke
