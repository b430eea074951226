// Contact of faces and springs, compiled for stepping: what touches, and what does not.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "sim/model/rest_lengths.h"

namespace hooke {

// A face, with the points and edges that no face before it has; or a spring that is not on a face, in the same way; or a sphere, a point
// on no spring or face, whose edge joins it to itself.
struct SurfacePiece {
  std::array<Index, 3> points{};  // of a spring: the third is the first; of a sphere: all are the same
  bool is_face = true;
  bool is_sphere() const { return !is_face && points[0] == points[1]; }
  Index first_edge = 0, end_edge = 0;      // of its own ones
  Index first_corner = 0, end_corner = 0;  // of its own ones
  unsigned char owned = 0;                 // of a face: bits of its own sides, and of its own corners from bit 3 on
};

// Indices of points refer to `points`, those of pieces, edges and corners to the lists below.
struct SurfacePlan {
  bool on = false;
  double friction = 0.0;          // [1]
  double restitution = 0.0;       // [1]
  double frequency = 0.0;         // [Hz], at which overlaps are removed
  double damping_ratio = 0.0;     // [1], of that
  std::vector<Index> points;      // of the scene, in ascending order
  std::vector<double> thickness;  // [m], per point: features touch at the minimum over their points; infinite for spheres
  std::vector<double> radius;     // [m], per point, of spheres, which touch at that in addition; 0 of others. Empty: there are no spheres
  double max_thickness = 0.0;     // [m]
  double edge_length = 0.0;       // [m], mean at rest, of springs on the edges; 0: there are none
  std::vector<SurfacePiece> pieces;  // faces, then springs, then spheres
  std::vector<EdgeEnds> edges;
  std::vector<char> is_spring;  // per edge, whether it is on no face
  std::vector<Index> corners;   // every point once
  // Points joined by a spring no longer than the thickness, and those joined by any spring if springs touch; sorted.
  std::vector<EdgeEnds> close, joined;

  // Whether features with these points never touch: they share a point, or springs keep them close to each other.
  bool excludes_face(Index point, std::span<const Index> face) const;
  bool excludes_edge(Index edge, Index other) const;
  // Whether the point at which a face is closest to another point, by its weights there, belongs to it: inside, or on a side or corner that
  // no face before it has. Otherwise another face is as close.
  bool owns(Index piece, double at_first, double at_second, double at_third) const {
    const unsigned zeros = (at_first == 0.0 ? 1U : 0U) | (at_second == 0.0 ? 2U : 0U) | (at_third == 0.0 ? 4U : 0U);
    // bit of the side or corner on which it is: a side is opposite to the corner of weight zero
    constexpr std::array<unsigned char, 8> bit{0, 2, 4, 32, 1, 16, 8, 0};
    return bit[zeros] == 0 || (pieces[piece].owned & bit[zeros]) != 0;
  }
  bool is_sphere(Index edge) const { return edges[edge][0] == edges[edge][1]; }
  // Of a pair of features with these points [m]. A sphere comes first.
  double radius_of(const std::array<Index, 4>& pair) const { return radius.empty() ? 0.0 : radius[pair[0]]; }
  double thickness_of(const std::array<Index, 4>& pair) const {
    return std::min({thickness[pair[0]], thickness[pair[1]], thickness[pair[2]], thickness[pair[3]]});
  }
};

SurfacePlan plan_surface(const System& system);

}  // namespace hooke
