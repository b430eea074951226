#include "sim/model/face_list.h"

#include <cassert>
#include <utility>

namespace hooke {

FaceList::FaceList(const std::vector<Face>& faces) {
  reserve(faces.size());
  for (const Face& face : faces) push_back(face);
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

bool FaceList::is_quad(std::size_t f) const {
  if (f + 1 >= points_.size()) return false;
  const auto &first = points_[f], &second = points_[f + 1];
  return second[0] == first[2] && second[1] == first[1] && second[2] != first[0];
}

// The second order of the halves is taken where the first half and the face before would read as a quad.
void FaceList::push_quad(const Panel<PointId>& corners) {
  const auto& [a, b, c, d] = corners;
  push_back({{b, c, a}});
  push_back({{a, c, d}});
  const std::size_t f = size() - 2;
  if (f == 0 || !is_quad(f - 1)) return;
  points_[f] = {d, a, c};
  points_[f + 1] = {c, a, b};
}

void FaceList::push_triangle(std::array<PointId, 3> corners) {
  push_back({corners});
  if (size() > 1 && is_quad(size() - 2)) points_.back() = {corners[1], corners[2], corners[0]};
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
