// The faces of a scene as one smooth surface, lit from both sides, with what is printed on it or the strains of its springs.
#pragma once

#include "draw/net.h"

namespace hooke {

class ClothSurface {
 public:
  ClothSurface();
  void clear() { indices_.clear(); }
  // Faces with a corner that is no place are left out.
  void add(const Subject& subject, const Net& net);
  bool is_empty() const { return indices_.empty(); }
  void draw(const Shader& shader);

 private:
  struct Vertex {
    float clip[4];
    std::int16_t normal[4];  // as the viewer sees it
    float print[2];          // place on the picture, 1 being its width and height
    Ink ink;
  };
  void find_normals(const std::vector<Vec3>& position, const Net& net);
  void find_inks(const Subject& subject, const Net& net);
  void add_vertices(const Subject& subject, const Net& net);
  void upload_picture();

  std::vector<Vec3> normals_;                     // a point, each face's share by its area
  std::vector<Ink> inks_;                         // a point
  std::vector<float> strain_sum_, strain_count_;  // a point
  std::vector<Vertex> vertices_;
  std::vector<GLuint> indices_;  // of the faces that are drawn
  Stream stream_;

  std::shared_ptr<const Picture> wanted_, uploaded_;
  GlName texture_;
};

}  // namespace hooke
