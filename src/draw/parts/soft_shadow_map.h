// How much light from above each place of a flat map is kept from by what is over it: a picture of the shadows there, soft
// by as much as their things are high. Plain arithmetic, the same on every driver: no OpenGL.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace hooke {

class SoftShadowMap {
 public:
  // The light comes from a wide window above: a shadow is blurred by this much [m] per metre of height.
  static constexpr float softness = 0.4f;
  // Of the light from the side, what a sheet or stick on edge keeps away.
  static constexpr float edge_on_occlusion = 0.35f;

  // Forgets all. The map lies between `least` and `most` [m]; its longer side has this many texels, of equal sides.
  void begin(const glm::vec2& min, const glm::vec2& max, int texels);
  int width() const { return width_; }
  int height() const { return height_; }
  float texel() const { return texel_; }  // [m]

  // A small thing of this area [m^2] seen from below, its place being where it is on the map and its height [m]. What lies
  // outside the map's sides or beneath it is left out.
  void add(const glm::vec3& place, float area);
  // A stick of this width [m], and a sheet: seen on edge it still keeps some light away.
  void add_line(const glm::vec3& a, const glm::vec3& b, float width);
  void add_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

  // The shares kept away, from 0 to 255, row by row; none at the sides of the map, so that it has no edge.
  const std::vector<std::uint8_t>& finish();

 private:
  // What is about as high: the higher, the larger the texels, by twos; with some around the map that take what is blurred.
  struct Level {
    int width = 0, height = 0;
    std::vector<float> coverage;  // things' area by the texel's
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
