#include "sim/plan/hinges.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

#include "sim/model/portable_math.h"
#include "sim/plan/rest_faces.h"

namespace hooke {
namespace {

int corner_of(const RestFace& face, Index point) { return face.corners[0] == point ? 0 : face.corners[1] == point ? 1 : 2; }

// The hinge on side i of a face, with `other` across it: the points of the side are j and k, p and q the corners opposite. The weights are
//   c = (cot T_k + cot F_k) x_j + (cot T_j + cot F_j) x_k - (cot T_j + cot T_k) x_p - (cot F_j + cot F_k) x_q.
void add_hinge(const RestFace& face, int i, const RestFace& other, HingedFace& hinged) {
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  const int other_j = corner_of(other, face.corners[j]), other_k = corner_of(other, face.corners[k]), opposite = 3 - other_j - other_k;
  auto& w = hinged.weights[i];
  w[j] = face.cotangent[k] + other.cotangent[other_k];
  w[k] = face.cotangent[j] + other.cotangent[other_j];
  w[i] = -(face.cotangent[j] + face.cotangent[k]);
  w[3] = -(other.cotangent[other_j] + other.cotangent[other_k]);
  hinged.points[3 + i] = other.corners[opposite];
}

// M_ij = (n_i.n_j)^2 / (4 A), with n the normals of the sides in the plane of the face.
void set_coupling(const RestFace& face, HingedFace& hinged) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int k = 3 - i - j;  // the corner between both sides
      const double cosine = i == j ? 1.0 : 2.0 * face.area * face.cotangent[k] / (face.length[i] * face.length[j]);
      hinged.coupling[i][j] = cosine * cosine / (4.0 * face.area);
    }
}

// Calls `use` for both sides of every edge of two faces.
template <class Use>
void for_each_hinge(const System& system, const Use& use) {
  for_each_edge(sorted_edges(system), [&](std::span<const FaceEdge> same) {
    // the same face twice has no other corner
    if (same.size() != 2 || same.front().opposite == same.back().opposite) return;
    use(same.front(), same.back());
    use(same.back(), same.front());
  });
}

// K_ab of one face.
double face_stiffness(const HingedFace& face, int a, int b) {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum += face.weight(i, a) * face.coupling[i][j] * face.weight(j, b);
  return sum;
}

void assemble_rows(HingePlan& plan, Index points) {
  std::vector<std::vector<std::pair<Index, double>>> rows(static_cast<std::size_t>(points));
  const auto occurs = [](const HingedFace& face, int a) { return a < 3 || face.points[a] != face.points[a - 3]; };
  for (const HingedFace& face : plan.faces)
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b)
        if (occurs(face, a) && occurs(face, b)) rows[face.points[a]].emplace_back(face.points[b], face_stiffness(face, a, b));

  plan.begin.assign(1, 0);
  for (auto& row : rows) {
    std::ranges::stable_sort(row, {}, &std::pair<Index, double>::first);
    for (const auto& [column, value] : row) {
      if (static_cast<Index>(plan.column.size()) == plan.begin.back() || plan.column.back() != column) {
        plan.column.push_back(column);
        plan.value.push_back(0.0);
      }
      plan.value.back() += value;
    }
    plan.begin.push_back(static_cast<Index>(plan.column.size()));
  }
}

}  // namespace

Index HingePlan::entry(Index i, Index j) const {
  const auto row = column.begin() + begin[i];
  return static_cast<Index>(std::lower_bound(row, column.begin() + begin[i + 1], j) - column.begin());
}

double hinge_angle(const Vec3& i, const Vec3& j, const Vec3& k, const Vec3& q) {
  const Vec3 own = glm::cross(j - i, k - i), other = glm::cross(j - k, q - k), edge = k - j;
  const double own_size = glm::length(own), other_size = glm::length(other), length = glm::length(edge);
  if (!(own_size > 0.0) || !(other_size > 0.0) || !(length > 0.0)) return 0.0;
  const Vec3 n = own / own_size, m = other / other_size;
  const double angle = portable::atan2(glm::dot(glm::cross(n, m), edge / length), glm::dot(n, m));
  return std::isfinite(angle) ? angle : 0.0;
}

void set_rest_angles(System& system, const std::vector<Vec3>& position) {
  NumberList angles;
  angles.reserve(3 * system.faces.size());
  angles.resize(3 * system.faces.size(), 0.0);
  if (system.dimensions == 3)
    for_each_hinge(system, [&](const FaceEdge& own, const FaceEdge& other) {
      const auto corner = [&](int c) { return position[system.index_of(system.faces[own.face].points[(own.corner + c) % 3])]; };
      angles.set(3 * static_cast<std::size_t>(own.face) + static_cast<std::size_t>(own.corner),
                 hinge_angle(corner(0), corner(1), corner(2), position[other.opposite]));
    });
  system.faces.set_rest_angles(std::move(angles));
}

HingePlan plan_hinges(const System& system) {
  HingePlan plan;
  if (system.dimensions == 2 || system.faces.empty()) return plan;
  const RestLengths lengths(system);
  std::vector<RestFace> rest;
  rest.reserve(system.faces.size());
  for (const Face& face : system.faces) rest.push_back(rest_face(system, lengths, face));

  std::vector<HingedFace> hinged(rest.size());
  for (std::size_t f = 0; f < rest.size(); ++f)
    for (int a = 0; a < 6; ++a) hinged[f].points[a] = rest[f].corners[a % 3];
  for_each_hinge(system, [&](const FaceEdge& own, const FaceEdge& other) {
    if (rest[own.face].area > 0.0 && rest[other.face].area > 0.0) add_hinge(rest[own.face], own.corner, rest[other.face], hinged[own.face]);
  });
  for (std::size_t f = 0; f < rest.size(); ++f) {
    if (std::ranges::equal(hinged[f].points.begin(), hinged[f].points.begin() + 3, hinged[f].points.begin() + 3, hinged[f].points.end()))
      continue;
    set_coupling(rest[f], hinged[f]);
    hinged[f].length = rest[f].length;
    hinged[f].rest_angle = system.faces[f].rest_angle;
    plan.faces.push_back(hinged[f]);
  }
  if (!plan.faces.empty()) assemble_rows(plan, system.point_count());
  return plan;
}

}  // namespace hooke
