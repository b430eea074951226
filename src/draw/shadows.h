// Soft shadows of what is near the ground, a ball or the top of a box, so that one sees how far it is above them.
#pragma once

#include <vector>

#include "draw/balls.h"
#include "draw/batch.h"
#include "draw/casters.h"
#include "draw/shade_map.h"

namespace hooke {

class Shader;

class Shadows {
 public:
  Shadows();
  void clear();
  // Works out what is shaded; needs what the net has seen.
  void add(const Subject& subject, const Net& net);
  BallShade on_ball(Index collider) const;
  // The maps as the texture that is bound; does nothing without shadows.
  void bind();
  // Those on flat things, over them.
  void draw(const Shader& shader, Ink ink);

 private:
  // A map and where it is in the picture of all maps.
  struct Tile {
    Index collider = no_index;
    int x = 0, y = 0, width = 0, height = 0;  // [texels]
    std::vector<std::uint8_t> shares;
    glm::vec2 least{0.0f}, most{0.0f};  // [m]
  };
  struct Vertex {
    float clip[4];
    float place[2];  // in the picture of all maps
    float fade[2];   // as the ground under it has
  };
  bool is_full() const;
  const Tile* shade(const Subject& subject, const Net& net, const Receiver& receiver);
  void add_flat(const Subject& subject, const Net& net, const Receiver& receiver, double reach);
  void upload();

  Casters casters_;
  ShadeMap map_;
  std::vector<Tile> tiles_;
  std::vector<Vertex> vertices_;
  Stream stream_;
  GlName texture_;
  bool uploaded_ = false;
};

}  // namespace hooke
