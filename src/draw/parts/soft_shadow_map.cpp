#include "draw/parts/soft_shadow_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace hooke {
namespace {

// [texels], standard deviation of the blur of one level.
constexpr float blur = 1.1f;
constexpr int max_steps = 64;

// Blurs a row or column with the binomial kernel 1 4 6 4 1.
void spread(const std::vector<float>& from, std::vector<float>& to, int count, int stride, int rows, int row_stride) {
  for (int row = 0; row < rows; ++row) {
    const float* in = &from[static_cast<std::size_t>(row) * row_stride];
    float* out = &to[static_cast<std::size_t>(row) * row_stride];
    const auto at = [&](int i) { return i < 0 || i >= count ? 0.0f : in[i * stride]; };
    for (int i = 0; i < count; ++i) out[i * stride] = (at(i - 2) + at(i + 2)) / 16.0f + (at(i - 1) + at(i + 1)) / 4.0f + at(i) * 0.375f;
  }
}

// From 0 at the border of the map to 1 at a twelfth of its size inside.
float within(int i, int count) {
  const float inside = static_cast<float>(std::min(i, count - 1 - i)) / (static_cast<float>(count) / 12.0f);
  const float t = std::min(inside, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

}  // namespace

void SoftShadowMap::begin(const glm::vec2& min, const glm::vec2& max, int texels) {
  min_ = min;
  const glm::vec2 size = glm::max(max - min, 1e-6f);
  texel_ = std::max(size.x, size.y) / static_cast<float>(texels);
  width_ = std::clamp(static_cast<int>(std::ceil(size.x / texel_)), 1, texels);
  height_ = std::clamp(static_cast<int>(std::ceil(size.y / texel_)), 1, texels);
  int width = width_, height = height_;
  for (Level& level : levels_) {
    level.width = width + 2 * padding;
    level.height = height + 2 * padding;
    level.coverage.assign(static_cast<std::size_t>(level.width) * level.height, 0.0f);
    width = (width + 1) / 2;
    height = (height + 1) / 2;
  }
}

// The width of a shadow lies between the texels of level `below` and the next; `above` in [0, 1] interpolates.
struct SoftShadowMap::Width {
  int below = 0;
  float above = 0.0f;
};

SoftShadowMap::Width SoftShadowMap::width_at(float height) const {
  const float wide = height * softness / (blur * texel_);
  if (!(wide > 1.0f)) return {};
  // The exponent of a floating-point number is the integer part of its binary logarithm.
  const int below = static_cast<int>(std::bit_cast<std::uint32_t>(wide) >> 23) - 127;
  return {below, below < level_count ? wide / static_cast<float>(1 << below) - 1.0f : 0.0f};
}

void SoftShadowMap::add_to(int level, const glm::vec2& at, float coverage) {
  Level& to = levels_[level];
  const auto size = static_cast<float>(1 << level);
  const float x = at.x / size + (padding - 0.5f), y = at.y / size + (padding - 0.5f);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const float right = x - static_cast<float>(i), upper = y - static_cast<float>(j);
  const float fraction = coverage / (size * size);
  float* texel = &to.coverage[static_cast<std::size_t>(j) * to.width + i];
  texel[0] += fraction * (1.0f - right) * (1.0f - upper);
  texel[1] += fraction * right * (1.0f - upper);
  texel[to.width] += fraction * (1.0f - right) * upper;
  texel[to.width + 1] += fraction * right * upper;
}

void SoftShadowMap::add(const glm::vec3& place, float area) {
  const glm::vec2 at = (glm::vec2(place) - min_) / texel_;
  const bool is_on_map = at.x >= 0.0f && at.y >= 0.0f && at.x <= static_cast<float>(width_) && at.y <= static_cast<float>(height_);
  if (!is_on_map || !(place.z >= 0.0f)) return;
  const auto [below, above] = width_at(place.z);
  if (below >= level_count) return;
  const float coverage = area / (texel_ * texel_);
  add_to(below, at, coverage * (1.0f - above));
  if (below + 1 < level_count && above > 0.0f) add_to(below + 1, at, coverage * above);
}

// Samples one texel apart, on the level of the lowest point.
int SoftShadowMap::steps_for(float length, float lowest) const {
  if (!(length > texel_)) return 1;
  const float apart = texel_ * static_cast<float>(1 << std::min(width_at(lowest).below, level_count - 1));
  return static_cast<int>(std::clamp(std::ceil(length / apart), 1.0f, static_cast<float>(max_steps)));
}

void SoftShadowMap::add_line(const glm::vec3& a, const glm::vec3& b, float width) {
  if (!std::isfinite(a.z + b.z)) return;
  const float length = glm::distance(a, b), across = glm::distance(glm::vec2(a), glm::vec2(b));
  const int steps = steps_for(across, std::min(a.z, b.z));
  const float area = width * std::max(across, edge_on_occlusion * length) / static_cast<float>(steps);
  for (int i = 0; i < steps; ++i) add(glm::mix(a, b, (static_cast<float>(i) + 0.5f) / static_cast<float>(steps)), area);
}

void SoftShadowMap::add_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  if (!std::isfinite(a.z + b.z + c.z)) return;
  const glm::vec3 normal = glm::cross(b - a, c - a);
  const float area = 0.5f * std::max(std::abs(normal.z), edge_on_occlusion * glm::length(normal));
  const auto far = [](const glm::vec3& p, const glm::vec3& q) { return std::max(std::abs(p.x - q.x), std::abs(p.y - q.y)); };
  const int steps = steps_for(std::max({far(a, b), far(b, c), far(c, a)}), std::min({a.z, b.z, c.z}));
  if (steps == 1) return add((a + b + c) / 3.0f, area);

  // The centers of the small triangles that it is divided into, both upright and inverted.
  const float each = area / static_cast<float>(steps * steps), whole = static_cast<float>(3 * steps);
  for (int i = 0; i < steps; ++i)
    for (int j = 0; i + j < steps; ++j)
      for (const int part : {1, 2}) {
        if (part == 2 && i + j + 1 == steps) continue;
        const float s = static_cast<float>(3 * i + part) / whole, t = static_cast<float>(3 * j + part) / whole;
        add(a + s * (b - a) + t * (c - a), each);
      }
}

const std::vector<std::uint8_t>& SoftShadowMap::finish() {
  // From the highest level down: the blurred level plus the next one, upsampled by two.
  for (int l = level_count - 1; l >= 0; --l) {
    Level& level = levels_[l];
    blurred_.resize(level.coverage.size());
    spread(level.coverage, blurred_, level.width, 1, level.height, level.width);
    spread(blurred_, level.coverage, level.height, level.width, level.width, 1);
    if (l + 1 == level_count) continue;
    const Level& higher = levels_[l + 1];
    for (int j = 0; j < level.height; ++j)
      for (int i = 0; i < level.width; ++i) {
        const int x = (2 * i + 3) / 4, y = (2 * j + 3) / 4;
        const float right = i % 2 == 0 ? 0.75f : 0.25f, upper = j % 2 == 0 ? 0.75f : 0.25f;
        const float* texel = &higher.coverage[static_cast<std::size_t>(y) * higher.width + x];
        const float low = glm::mix(texel[0], texel[1], right), high = glm::mix(texel[higher.width], texel[higher.width + 1], right);
        level.coverage[static_cast<std::size_t>(j) * level.width + i] += glm::mix(low, high, upper);
      }
  }

  // Overlapping objects block at most all of the light.
  occlusion_.resize(static_cast<std::size_t>(width_) * height_);
  const Level& sharpest = levels_.front();
  for (int j = 0; j < height_; ++j)
    for (int i = 0; i < width_; ++i) {
      const float coverage = sharpest.coverage[static_cast<std::size_t>(j + padding) * sharpest.width + i + padding];
      const float fraction = (1.0f - std::exp(-1.7f * coverage)) * within(i, width_) * within(j, height_);
      occlusion_[static_cast<std::size_t>(j) * width_ + i] = static_cast<std::uint8_t>(std::lround(255.0f * fraction));
    }
  return occlusion_;
}

}  // namespace hooke
