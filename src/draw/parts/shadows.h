// Soft shadows on the ground, on balls and on the tops of boxes, which show how high objects are above them.
#pragma once

#include <vector>

#include "draw/gl/vertex_stream.h"
#include "draw/parts/balls.h"
#include "draw/parts/shadow_casters.h"
#include "draw/parts/soft_shadow_map.h"

namespace hooke {

class Shader;

class Shadows {
 public:
  Shadows();
  void clear();
  // Computes the shadows. Needs the projected points of the network.
  void add(const DrawContext& context, const NetworkRenderer& network_renderer);
  BallShadow on_ball(Index collider) const;
  // Binds the texture of all maps; does nothing without shadows.
  void bind();
  // Draws the shadows on flat receivers.
  void draw(const Shader& shader, Rgba rgba);

 private:
  // A map and its position in the atlas of all maps.
  struct Tile {
    Index collider = no_index;
    int x = 0, y = 0, width = 0, height = 0;  // [texels]
    std::vector<std::uint8_t> occlusion;
    glm::vec2 min{0.0f}, max{0.0f};  // [m]
  };
  struct Vertex {
    float clip[4];
    float place[2];  // in the atlas
    float fade[2];   // like the ground below it
  };
  bool is_full() const;
  const Tile* shade(const DrawContext& context, const NetworkRenderer& network_renderer, const ShadowReceiver& receiver);
  void add_flat(const DrawContext& context, const NetworkRenderer& network_renderer, const ShadowReceiver& receiver, double reach);
  void upload();

  ShadowCasters shadow_casters_;
  SoftShadowMap map_;
  std::vector<Tile> tiles_;
  std::vector<Vertex> vertices_;
  VertexStream stream_;
  GlName texture_;
  bool uploaded_ = false;
};

}  // namespace hooke
