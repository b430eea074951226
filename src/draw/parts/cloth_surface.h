// The faces of a scene as one smooth surface, lit from both sides, with what is printed on it or the strains of its springs.
#pragma once

#include "draw/parts/network_renderer.h"

namespace hooke {

class ClothSurface {
 public:
  ClothSurface();
  void clear() { indices_.clear(); }
  // Faces with a corner that is no place are left out.
  void add(const DrawContext& context, const NetworkRenderer& network_renderer);
  bool is_empty() const { return indices_.empty(); }
  void draw(const Shader& shader);

 private:
  struct Vertex {
    float clip[4];
    std::int16_t normal[4];  // as the viewer sees it
    float cloth_texture[2];  // place on the picture, 1 being its width and height
    Rgba rgba;
  };
  void find_normals(const std::vector<Vec3>& position, const NetworkRenderer& network_renderer);
  void find_colors(const DrawContext& context, const NetworkRenderer& network_renderer);
  void add_vertices(const DrawContext& context, const NetworkRenderer& network_renderer);
  void upload_picture();

  std::vector<Vec3> normals_;                     // a point, each face's share by its area
  std::vector<Rgba> colors_;                      // a point
  std::vector<float> strain_sum_, strain_count_;  // a point
  std::vector<Vertex> vertices_;
  std::vector<GLuint> indices_;  // of the faces that are drawn
  VertexStream stream_;

  std::shared_ptr<const Picture> request_, uploaded_;
  GlName texture_;
};

}  // namespace hooke
