// The faces of a System. Most have the same angles at rest, those of a flat sheet: each different number is stored once.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/lists/number_list.h"
#include "base/lists/value_list.h"
#include "base/types.h"

namespace hooke {

// A triangle of three points, for drawing, contact, wind, bending and pressure; it has no elastic force of its own.
struct Face {
  std::array<PointId, 3> points{};
  // [rad], to the other face at the side opposite each corner, as built: 0 flat, positive where the other face bends away from the normal.
  std::array<double, 3> rest_angle{};
  bool operator==(const Face&) const = default;
};

// The corners of a quad in order around it. A face has no fourth one.
template <class Id>
using Panel = std::array<Id, 4>;

// Reads like a vector of faces, but returns values instead of references. Two faces in succession (a, b, c) and (c, b, d) are the halves of
// a quad: its mass, wind and pressure act in equal parts on its four corners, and do not depend on the diagonal.
class FaceList : public ValueList<FaceList, Face> {
 public:
  FaceList() = default;
  FaceList(const std::vector<Face>& faces);  // implicit: wherever a plain list is at hand
  operator std::vector<Face>() const { return {begin(), end()}; }

  std::size_t size() const { return points_.size(); }
  Face operator[](std::size_t f) const {
    return {.points = points_[f], .rest_angle = {rest_angles_[3 * f], rest_angles_[3 * f + 1], rest_angles_[3 * f + 2]}};
  }

  void reserve(std::size_t capacity);
  void clear() { *this = FaceList(); }
  // Removes all faces from this one on.
  void truncate(std::size_t size);
  void push_back(const Face& face);
  // The halves of a quad with these corners in order around it; the diagonal is from the first to the third.
  void push_quad(const Panel<PointId>& corners);
  // A face that is no half of a quad.
  void push_triangle(std::array<PointId, 3> corners);
  // Whether the face f, which is not the second half of a quad, is the first one.
  bool is_quad(std::size_t f) const;
  // Its corners in order; the diagonal is from the second to the fourth.
  Panel<PointId> quad(std::size_t f) const { return {points_[f][0], points_[f][1], points_[f + 1][2], points_[f][2]}; }
  void pop_back() { truncate(size() - 1); }
  void set_points(std::size_t f, const std::array<PointId, 3>& points) { points_[f] = points; }
  // The faces of these indices, in this order.
  FaceList select(std::span<const Index> indices) const;
  // [rad], of all faces, those of the corners one after another.
  void set_rest_angles(NumberList angles);

  // [bytes], of all faces.
  std::size_t bytes() const { return points_.capacity() * sizeof(points_[0]) + rest_angles_.bytes(); }
  bool operator==(const FaceList& other) const = default;

 private:
  std::vector<std::array<PointId, 3>> points_;
  NumberList rest_angles_;
};

}  // namespace hooke
