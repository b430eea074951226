// The broad phase of contact between faces and springs: a tree of bounding boxes over the pieces of a surface.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/contact/box_tree.h"
#include "sim/contact/closest.h"
#include "sim/plan/surface_plan.h"

namespace hooke {

// Two features with four points.
struct SurfacePair {
  FeaturePair kind = FeaturePair::PointFace;
  std::array<Index, 4> points{};
  std::array<Index, 2> features{};  // of the plan: a piece and no_index, or two edges
  double distance = 0.0;            // [m], of spheres from their surface
};
// By their kinds.
using SurfacePairs = std::array<std::vector<SurfacePair>, 2>;

// An edge that passes through a face.
struct Crossing {
  Index edge = 0, face = 0;  // of the SurfacePlan: edge and piece
};
struct Crossings {
  std::vector<Crossing> found;
  bool is_complete = true;  // false: so many pieces are close to each other that the search ended
};

// How far the features at a point are left alone: pairs of an edge, or a point, that is on no face, or all.
enum class LeftOut : char { Nothing, Springs, All };

class SurfaceTree {
 public:
  // Sorts the pieces by their places, x per point of the plan. O(n log n).
  void build(const SurfacePlan& plan, std::span<const Vec3> x);
  bool is_built() const { return tree_.is_built(); }
  void clear() { tree_.clear(); }

  // Points have moved to x.
  void refit(std::span<const Vec3> x);

  // Sets `pairs` to the pairs of features that do not belong together, without those with points on both sides that are left out
  // (empty: none are), if they are closer than `reach` [m]. They are found in an order that depends on the last `build` alone: with a
  // longer reach, others come in between. False if there would be more than max_pairs.
  bool find_pairs(const SurfacePlan& plan, std::span<const Vec3> x, double reach, std::span<const LeftOut> left_out, std::size_t max_pairs,
                  SurfacePairs& pairs) const;
  // Edges that pass through faces, without springs that others join to the face: they may pass its edges.
  Crossings find_crossings(const SurfacePlan& plan, std::span<const Vec3> x) const;

 private:
  static constexpr Index features_per_leaf = 3 * BoxTree::max_per_leaf;
  using ClosePairs = std::array<std::array<Index, 2>, static_cast<std::size_t>(features_per_leaf* features_per_leaf)>;
  using Node = BoxTree::Node;
  enum Feature { Piece, Corner, Edge };

  SurfaceBox fit_features(std::span<const Vec3> x, const BoxRange& pieces);
  BoxSet boxes_of(Feature feature, const Node& leaf) const;
  std::span<const std::array<Index, 2>> find_close(const BoxSet& first, const BoxSet& second, double reach, ClosePairs& room) const;
  void append_close(const SurfacePlan& plan, const Node& first, const Node& second, double reach, std::span<const LeftOut> left_out,
                    SurfacePairs& pairs) const;

  BoxTree tree_;  // of the pieces

  // Of the plan, in the order of the tree; and where the corners and edges of each piece begin.
  std::vector<Index> corners_, edges_, first_corner_, first_edge_;
  std::vector<std::array<Index, 3>> piece_points_;
  std::vector<EdgeEnds> edge_ends_;
  std::vector<char> is_face_;     // per piece
  std::vector<char> is_on_face_;  // per corner
  std::vector<double> radius_;    // [m], per point of the plan, of spheres; empty: there are none
  std::array<SurfaceBoxes, 3> boxes_;
};

}  // namespace hooke
