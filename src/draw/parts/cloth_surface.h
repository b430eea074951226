// The faces of a scene as a smooth surface, lit from both sides, with a texture or the strains of its springs.
#pragma once

#include "draw/parts/network_renderer.h"
#include "draw/pixel_box.h"

namespace hooke {

class ClothSurface {
 public:
  ClothSurface();
  void clear() { indices_.clear(); }
  // Faces with a corner at a non-finite position are ignored.
  void add(const DrawContext& context, const NetworkRenderer& network_renderer);
  bool is_empty() const { return indices_.empty(); }
  void extend(PixelExtent& extent, const NetworkRenderer& network_renderer) const;
  void draw(const Shader& shader);

 private:
  struct Vertex {
    float clip[4];
    std::int16_t normal[4];  // in view coordinates
    float cloth_texture[2];  // texture coordinates, 1 is the width and height of the texture
    Rgba rgba;
  };
  void find_normals(const std::vector<Vec3>& position, const NetworkRenderer& network_renderer);
  void find_colors(const DrawContext& context, const NetworkRenderer& network_renderer);
  void add_vertices(const DrawContext& context, const NetworkRenderer& network_renderer);
  void upload_picture();

  std::vector<Vec3> normals_;                     // per point, each face weighted by its area
  std::vector<Rgba> colors_;                      // per point
  std::vector<float> strain_sum_, strain_count_;  // per point
  std::vector<Vertex> vertices_;
  std::vector<GLuint> indices_, numbered_;  // corners of the visible faces, as indices of points and of vertices
  VertexStream stream_;

  std::shared_ptr<const Picture> request_, uploaded_;
  GlName texture_;
};

}  // namespace hooke
