#include "draw/cloth_mesh.h"

#include <glm/geometric.hpp>

namespace hooke {

void ClothMesh::add(const Subject& subject, const Net& net, Surfaces& surfaces) {
  const System& system = *subject.snapshot.system;
  const std::vector<Vec3>& position = subject.snapshot.state.position;
  if (system.faces.empty()) return;

  // twice a face's area is the length of its normal
  normals_.assign(position.size(), Vec3(0.0));
  corners_.clear();
  for (const Face& face : system.faces) {
    const Index a = system.index_of(face.points[0]), b = system.index_of(face.points[1]), c = system.index_of(face.points[2]);
    if ((net.seen()[a].outside | net.seen()[b].outside | net.seen()[c].outside) & not_a_place) continue;
    const Vec3 normal = glm::cross(position[b] - position[a], position[c] - position[a]);
    for (const Index corner : {a, b, c}) {
      normals_[corner] += normal;
      corners_.push_back(corner);
    }
  }

  const Ink color = ink(subject.palette.face);
  const GLuint first = surfaces.corner_count();
  for (std::size_t i = 0; i < position.size(); ++i) surfaces.add_corner(net.clip()[i], subject.projection.turned(normals_[i]), color);
  for (std::size_t f = 0; f < corners_.size(); f += 3)
    surfaces.add_triangle(first + corners_[f], first + corners_[f + 1], first + corners_[f + 2]);
}

}  // namespace hooke
