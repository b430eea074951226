// The objects that cast shadows on a receiver: the visible network and solid colliders.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "draw/parts/network_renderer.h"
#include "draw/parts/soft_shadow_map.h"

namespace hooke {

// A flat surface or the upper half of a ball, with local coordinates: across, along and above.
struct ShadowReceiver {
  Index collider = no_index;
  Vec3 origin{0.0}, across{1.0, 0.0, 0.0}, along{0.0, 1.0, 0.0}, above{0.0, 0.0, 1.0};
  glm::vec2 min{0.0f}, max{0.0f};  // [m], across and along: the region that receives shadows
  float radius = 0.0f;             // [m]; 0: flat

  glm::vec3 place_of(const Vec3& world) const;
  // The height above the surface [m], not negative; NaN if the position is not over the receiver. Positions up to
  // `depth_tolerance` [m] below the surface count as on it.
  float height_of(const glm::vec3& place, float depth_tolerance) const;
};

class ShadowCasters {
 public:
  // Fills the map with the shadow on the receiver and sets its bounds. Returns false if nothing casts a shadow there.
  bool shade(const DrawContext& context, const NetworkRenderer& network_renderer, const ShadowReceiver& receiver, int texels,
             SoftShadowMap& map, glm::vec2& min, glm::vec2& max);

 private:
  // Bounds on the receiver and height above it [m].
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

  std::vector<glm::vec3> places_;  // per point, z is the height; NaN if not over the receiver
  float widest_ = 0.0f;            // [m], the largest radius of a point
};

}  // namespace hooke
