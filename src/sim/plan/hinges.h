// The hinges of sheets, on the edges that two faces share, as the bending force needs them (terms/bending.cpp, where the formulas are).
#pragma once

#include <array>
#include <vector>

#include "sim/model/system.h"

namespace hooke {

// A face with up to three hinges. Hinge i is on the edge opposite corner i.
struct HingedFace {
  // Of points: the corners, then the corner of the other face of each hinge; corner i itself where there is no hinge.
  std::array<Index, 6> points{};
  // [1], c_i = sum w x over the corners and points[3 + i]; zero where there is no hinge.
  std::array<std::array<double, 4>, 3> weights{};
  std::array<std::array<double, 3>, 3> coupling{};  // M_ij [1/m^2]
  std::array<double, 3> length{}, rest_angle{};     // of the hinges at rest [m], as built [rad]

  // The weight of points[local] in c_i.
  double weight(int hinge, int local) const { return local < 3 ? weights[hinge][local] : local == 3 + hinge ? weights[hinge][3] : 0.0; }
};

// The faces with hinges, and the matrix of the energy E = B/2 sum K_ij x_i.x_j, K = sum over the faces of w^T M w [1/m^2], by rows: entries
// begin[i] to begin[i + 1] of row i, in ascending order of columns.
struct HingePlan {
  std::vector<HingedFace> faces;
  std::vector<Index> begin, column;
  std::vector<double> value;

  bool empty() const { return faces.empty(); }
  // The entry of row i in this column, which must exist.
  Index entry(Index i, Index j) const;
};

// The angle [rad] from the face of corners i, j and k to the one of k, j and q, across the edge from j to k: 0 if both are in a plane,
// positive where q is on the side that the normal (j - i) x (k - i) does not point to. 0 if one of them is degenerate.
double hinge_angle(const Vec3& i, const Vec3& j, const Vec3& k, const Vec3& q);

// Sets the angles of all faces to those at these positions; 0 where there is no hinge.
void set_rest_angles(System& system, const std::vector<Vec3>& position);

// From the rest lengths of the springs along the edges. A face has no hinge if it is degenerate, or if more than one of its edges has no
// spring; where one has none, its angle is taken as right: that edge is a diagonal. Nor has an edge of more or less than two faces. Empty
// in flat scenes.
HingePlan plan_hinges(const System& system);

}  // namespace hooke
