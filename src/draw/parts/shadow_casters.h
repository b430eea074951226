// What of a scene keeps light from a place that shadows fall on: as much of the network as is shown, and solid colliders.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "draw/parts/network_renderer.h"
#include "draw/parts/soft_shadow_map.h"

namespace hooke {

// A flat place, or the upper half of a ball, with coordinates of its own: across, along and above it.
struct ShadowReceiver {
  Index collider = no_index;
  Vec3 origin{0.0}, across{1.0, 0.0, 0.0}, along{0.0, 1.0, 0.0}, above{0.0, 0.0, 1.0};
  glm::vec2 min{0.0f}, max{0.0f};  // [m], across and along, that light is wanted on
  float radius = 0.0f;             // [m], of the ball; 0: flat

  glm::vec3 place_of(const Vec3& world) const;
  // [m] above its surface, not negative; no number where a place is not over it. What lies up to `sunk` [m] beneath
  // counts as upon it.
  float height_of(const glm::vec3& place, float depth_tolerance) const;
};

class ShadowCasters {
 public:
  // False when nothing is near, else the map is that of the shade on the receiver. Returns the map's sides in `least` and `most`.
  bool shade(const DrawContext& context, const NetworkRenderer& network_renderer, const ShadowReceiver& receiver, int texels,
             SoftShadowMap& map, glm::vec2& min, glm::vec2& max);

 private:
  // Between these sides of the receiver, this high over it [m].
  struct Caster {
    glm::vec2 min, max;
    float height;
  };
  void find_places(const DrawContext& context, const ShadowReceiver& receiver);
  bool find_sides(const DrawContext& context, const ShadowReceiver& receiver, glm::vec2& min, glm::vec2& max) const;
  std::vector<Caster> colliders_over(const DrawContext& context, const ShadowReceiver& receiver) const;
  void add_net(const DrawContext& context, const NetworkRenderer& network_renderer, const ShadowReceiver& receiver,
               SoftShadowMap& map) const;
  void add_colliders(const DrawContext& context, const ShadowReceiver& receiver, SoftShadowMap& map) const;

  std::vector<glm::vec3> places_;  // a point, with its height; no number where it is not over the receiver
  float widest_ = 0.0f;            // [m], the largest radius of a point
};

}  // namespace hooke
