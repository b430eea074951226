#include "sim/model/face_list.h"

#include <cassert>
#include <utility>

namespace hooke {

FaceList::FaceList(const std::vector<Face>& faces) {
  reserve(faces.size());
  for (const Face& face : faces) push_back(face);
}

FaceList::operator std::vector<Face>() const {
  std::vector<Face> faces;
  faces.reserve(size());
  for (const Face& face : *this) faces.push_back(face);
  return faces;
}

void FaceList::reserve(std::size_t capacity) {
  points_.reserve(capacity);
  rest_angles_.reserve(3 * capacity);
}

void FaceList::truncate(std::size_t size) {
  points_.resize(size);
  rest_angles_.resize(3 * size, 0.0);
}

void FaceList::push_back(const Face& face) {
  points_.push_back(face.points);
  for (const double angle : face.rest_angle) rest_angles_.push_back(angle);
}

FaceList FaceList::select(std::span<const Index> indices) const {
  FaceList selected;
  selected.points_.reserve(indices.size());
  std::vector<Index> angles;
  angles.reserve(3 * indices.size());
  for (const Index f : indices) {
    selected.points_.push_back(points_[f]);
    for (Index corner = 0; corner < 3; ++corner) angles.push_back(3 * f + corner);
  }
  selected.rest_angles_ = rest_angles_.select(angles);
  return selected;
}

void FaceList::set_rest_angles(NumberList angles) {
  assert(angles.size() == 3 * size());
  rest_angles_ = std::move(angles);
}

}  // namespace hooke
