#include "draw/parts/shadow_casters.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <variant>

namespace hooke {
namespace {

constexpr float not_over = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();
// Objects higher above the receiver than this multiple of their width cast no visible shadow.
constexpr float highest = 4.0f;

// The visible solid colliders, except the receiver itself, at their current positions.
template <class Use>
void each_collider(const DrawContext& context, const ShadowReceiver& receiver, Use use) {
  const System& system = *context.snapshot.system;
  if (!context.options.colliders) return;
  for (std::size_t c = 0; c < system.colliders.size(); ++c)
    if (system.colliders[c].solid && static_cast<Index>(c) != receiver.collider) use(current_collider(system, context.snapshot.state, c));
}

int steps_across(float length, const SoftShadowMap& map) {
  constexpr float max_steps = 64.0f;
  return static_cast<int>(std::clamp(std::ceil(length / map.texel()), 1.0f, max_steps));
}

// The lower half of a ball, in columns. A column that reaches into the receiver counts as resting on it.
void add_ball(const glm::vec3& center, float radius, const ShadowReceiver& receiver, SoftShadowMap& map) {
  if (2.0f * radius < map.texel()) {
    const float height = receiver.height_of(center, radius);
    return map.add({center.x, center.y, std::max(height - radius, 0.0f)}, 3.14159f * radius * radius);
  }
  const int steps = steps_across(2.0f * radius, map);
  const float step = 2.0f * radius / static_cast<float>(steps);
  for (int j = 0; j < steps; ++j)
    for (int i = 0; i < steps; ++i) {
      const float x = (static_cast<float>(i) + 0.5f) * step - radius, y = (static_cast<float>(j) + 0.5f) * step - radius;
      const float square = radius * radius - x * x - y * y;
      if (square < 0.0f) continue;
      const float half = std::sqrt(square);
      const glm::vec3 below = center + glm::vec3(x, y, -half);
      map.add({below.x, below.y, receiver.height_of(below, 2.0f * half)}, step * step);
    }
}

// The sides that do not face upwards, in small pieces.
void add_box(const Box& box, const ShadowReceiver& receiver, SoftShadowMap& map) {
  constexpr int sides[6][3] = {{0, 2, 4}, {1, 2, 4}, {0, 1, 4}, {2, 1, 4}, {0, 1, 2}, {4, 1, 2}};
  const auto height = static_cast<float>(glm::dot(box.max - box.min, glm::abs(receiver.above)));
  for (int side = 0; side < 6; ++side) {
    Vec3 normal(0.0);
    normal[side / 2] = side % 2 == 0 ? -1.0 : 1.0;
    const double up = glm::dot(normal, receiver.above);
    if (up > 0.5) continue;
    const glm::vec3 from = receiver.place_of(box.corner(sides[side][0]));
    const glm::vec3 right = receiver.place_of(box.corner(sides[side][0] | sides[side][1])) - from;
    const glm::vec3 up_to = receiver.place_of(box.corner(sides[side][0] | sides[side][2])) - from;
    const int m = steps_across(glm::length(right), map), n = steps_across(glm::length(up_to), map);
    const float whole =
        glm::length(glm::cross(right, up_to)) * std::max(static_cast<float>(std::abs(up)), SoftShadowMap::edge_on_occlusion);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < m; ++i) {
        const glm::vec3 place = from + (static_cast<float>(i) + 0.5f) / static_cast<float>(m) * right +
                                (static_cast<float>(j) + 0.5f) / static_cast<float>(n) * up_to;
        map.add({place.x, place.y, receiver.height_of(place, up < -0.5 ? height : 0.0f)}, whole / static_cast<float>(m * n));
      }
  }
}

}  // namespace

glm::vec3 ShadowReceiver::place_of(const Vec3& world) const {
  const Vec3 offset = world - origin;
  return {glm::dot(offset, across), glm::dot(offset, along), glm::dot(offset, above)};
}

float ShadowReceiver::height_of(const glm::vec3& place, float depth_tolerance) const {
  float surface = 0.0f;
  if (radius > 0.0f) {
    // Beside the ball, the height of its center counts, so that objects larger than the ball are above it.
    surface = std::sqrt(std::max(radius * radius - place.x * place.x - place.y * place.y, 0.0f));
  }
  const float height = place.z - surface;
  return height >= -depth_tolerance ? std::max(height, 0.0f) : not_over;
}

bool ShadowCasters::shade(const DrawContext& context, const NetworkRenderer& network_renderer, const ShadowReceiver& receiver, int texels,
                          SoftShadowMap& map, glm::vec2& min, glm::vec2& max) {
  find_places(context, receiver);
  if (!find_sides(context, receiver, min, max)) return false;
  map.begin(min, max, texels);
  max = min + map.texel() * glm::vec2(map.width(), map.height());
  add_net(context, network_renderer, receiver, map);
  add_colliders(context, receiver, map);
  return true;
}

void ShadowCasters::find_places(const DrawContext& context, const ShadowReceiver& receiver) {
  const std::vector<Point>& points = context.snapshot.system->points();
  const ViewOptions& options = context.options;
  const bool is_shown = options.points || options.springs || options.surface;
  places_.resize(is_shown ? points.size() : 0);
  widest_ = 0.0f;
  // Chords of round colliders lie slightly below the surface, and so do points on a floor because of rounding.
  const float depth_tolerance = receiver.radius > 0.0f ? 0.1f * receiver.radius : 1e-3f * static_cast<float>(context.camera.distance);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const glm::vec3 place = receiver.place_of(context.snapshot.state.position[i]);
    const auto radius = static_cast<float>(points[i].radius);
    places_[i] = {place.x, place.y, receiver.height_of(place, depth_tolerance + radius)};
    widest_ = std::max(widest_, radius);
  }
}

// The bounds of the shadows within the region of the receiver: the objects, extended by the blur at their height.
bool ShadowCasters::find_sides(const DrawContext& context, const ShadowReceiver& receiver, glm::vec2& min, glm::vec2& max) const {
  const std::vector<Caster> casters = colliders_over(context, receiver);
  const glm::vec2 margin = 0.2f * (receiver.max - receiver.min);
  const glm::vec2 from = receiver.min - margin, to = receiver.max + margin;
  const auto each = [&](auto use) {
    for (const Caster& caster : casters) use(caster.min, caster.max, caster.height);
    for (const glm::vec3& place : places_)
      if (place.z < infinite) use(glm::vec2(place) - widest_, glm::vec2(place) + widest_, place.z);
  };

  glm::vec2 low(infinite), high(-infinite);
  each([&](const glm::vec2& caster_min, const glm::vec2& caster_max, float) {
    low = glm::min(low, caster_min);
    high = glm::max(high, caster_max);
  });
  const float wide = glm::distance(glm::max(low, from), glm::min(high, to));
  if (!(low.x <= to.x && low.y <= to.y && high.x >= from.x && high.y >= from.y && wide > 0.0f)) return false;
  min = glm::vec2(infinite);
  max = glm::vec2(-infinite);
  each([&](const glm::vec2& caster_min, const glm::vec2& caster_max, float height) {
    if (height > highest * wide) return;
    const float blur = std::min(2.0f * SoftShadowMap::softness * height, 0.5f * wide) + 0.06f * wide;
    min = glm::min(min, caster_min - blur);
    max = glm::max(max, caster_max + blur);
  });
  min = glm::max(min, from);
  max = glm::min(max, to);
  return min.x < max.x && min.y < max.y;
}

std::vector<ShadowCasters::Caster> ShadowCasters::colliders_over(const DrawContext& context, const ShadowReceiver& receiver) const {
  std::vector<Caster> casters;
  each_collider(context, receiver, [&](const Collider& collider) {
    if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) {
      const glm::vec3 center = receiver.place_of(sphere->center);
      const auto radius = static_cast<float>(sphere->radius);
      if (center.z > -radius)
        casters.push_back({glm::vec2(center) - radius, glm::vec2(center) + radius, std::max(center.z - radius, 0.0f)});
    }
    if (const auto* box = std::get_if<Box>(&collider.shape)) {
      glm::vec3 low(infinite), high(-infinite);
      for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 place = receiver.place_of(box->corner(corner));
        low = glm::min(low, place);
        high = glm::max(high, place);
      }
      if (high.z > 0.0f) casters.push_back({glm::vec2(low), glm::vec2(high), std::max(low.z, 0.0f)});
    }
  });
  return casters;
}

void ShadowCasters::add_net(const DrawContext& context, const NetworkRenderer& network_renderer, const ShadowReceiver& receiver,
                            SoftShadowMap& map) const {
  if (places_.empty()) return;
  const System& system = *context.snapshot.system;
  const ViewOptions& options = context.options;
  const bool has_cloth = options.surface && !network_renderer.corners().empty();
  if (has_cloth)
    for (std::size_t f = 0; f < network_renderer.corners().size(); f += 3)
      map.add_triangle(places_[network_renderer.corners()[f]], places_[network_renderer.corners()[f + 1]],
                       places_[network_renderer.corners()[f + 2]]);

  // Springs within the cloth are in its shadow anyway.
  const auto is_seen = [&](Index i) { return !has_cloth || network_renderer.is_outside_cloth(i); };
  if (options.springs || has_cloth)
    for (std::size_t s = 0; s < network_renderer.ends().size(); ++s) {
      const auto [a, b] = network_renderer.ends()[s];
      if ((!is_seen(a) && !is_seen(b)) || !system.is_on(system.springs()[s])) continue;
      const double width = 0.5 * (system.points()[a].radius + system.points()[b].radius);
      map.add_line(places_[a], places_[b], static_cast<float>(width));
    }
  if (options.points || has_cloth)
    for (Index i = 0; i < system.point_count(); ++i)
      if (is_seen(i) && places_[i].z < infinite)
        add_ball(receiver.place_of(context.snapshot.state.position[i]), static_cast<float>(system.points()[i].radius), receiver, map);
}

void ShadowCasters::add_colliders(const DrawContext& context, const ShadowReceiver& receiver, SoftShadowMap& map) const {
  each_collider(context, receiver, [&](const Collider& collider) {
    if (const auto* sphere = std::get_if<Sphere>(&collider.shape))
      add_ball(receiver.place_of(sphere->center), static_cast<float>(sphere->radius), receiver, map);
    if (const auto* box = std::get_if<Box>(&collider.shape)) add_box(*box, receiver, map);
  });
}

}  // namespace hooke
