// The broad phase of contact between faces and springs: a tree of bounding boxes over the pieces of a surface.
#pragma once

#include <vector>

#include "sim/contact/box_kernel.h"
#include "sim/contact/closest.h"
#include "sim/plan/surface_plan.h"

namespace hooke {

// Two features with four points.
struct SurfacePair {
  FeaturePair kind = FeaturePair::PointFace;
  bool has_spring = false;  // whether one of two edges is on no face
  std::array<Index, 4> points{};
  std::array<Index, 2> features{};  // of the plan: a piece and no_index, or two edges
};

// Pairs of one kind, in columns.
struct SurfacePairs {
  std::vector<std::array<Index, 4>> points;
  std::vector<std::array<Index, 2>> features;  // as those of SurfacePair

  std::size_t size() const { return points.size(); }
  void resize(std::size_t count) { points.resize(count), features.resize(count); }
  void set(std::size_t i, const SurfacePairs& from, std::size_t j) { points[i] = from.points[j], features[i] = from.features[j]; }
  SurfacePair pair(const SurfacePlan& plan, FeaturePair kind, std::size_t i) const {
    const auto [first, second] = features[i];
    const bool has_spring = kind == FeaturePair::TwoEdges && (plan.is_spring[first] | plan.is_spring[second]) != 0;
    return {.kind = kind, .has_spring = has_spring, .points = points[i], .features = features[i]};
  }
};
// Of both kinds.
using PairsByKind = std::array<SurfacePairs, 2>;

// How far the features at a point are left alone in a search of pairs with points on both sides that are.
enum class LeftOut : char {
  Nothing,
  Springs,  // pairs of an edge, or a point, that is on no face
  All,
};

// An edge that passes through a face.
struct Crossing {
  Index edge = 0, face = 0;  // of the SurfacePlan: edge and piece
};
struct Crossings {
  std::vector<Crossing> found;
  bool is_complete = true;  // false: so many pieces are close to each other that the search ended
};

class SurfaceTree {
 public:
  // Sorts the pieces by their places, x per point of the plan. O(n log n).
  void build(const SurfacePlan& plan, std::span<const Vec3> x);
  bool is_built() const { return !nodes_.empty(); }
  void clear() { nodes_.clear(); }

  // Appends the pairs of features that do not belong together, without those with points on both sides that are `left_out`, if they are
  // closer than `reach` [m]. Pairs are found in an order that depends on the last `build` alone: with a longer reach, others come in
  // between. False if there would be more than max_pairs.
  bool find_pairs(const SurfacePlan& plan, std::span<const Vec3> x, double reach, std::span<const LeftOut> left_out,
                  std::vector<SurfacePair>& pairs, std::size_t max_pairs);
  // Edges that pass through faces, without springs that others join to the face: they may pass its edges.
  Crossings find_crossings(const SurfacePlan& plan, std::span<const Vec3> x) const;

  // Leaves: pieces that are near each other, in an order that depends on the last `build` alone.
  Index leaf_count() const { return static_cast<Index>(leaves_.size()); }
  // All points of the pieces of a leaf, each once.
  std::span<const Index> points_of(Index leaf) const {
    return {leaf_points_.data() + first_point_[leaf], leaf_points_.data() + first_point_[leaf + 1]};
  }
  // One for each leaf, for find_leaf_pairs.
  void set_leaf_boxes(std::span<const SurfaceBox> boxes);
  // Appends the pairs of leaves whose boxes overlap, the first of them from `begin` to `end`, the second no lower: ascending, and those of
  // a leaf with itself included.
  void find_leaf_pairs(Index begin, Index end, std::vector<std::array<Index, 2>>& pairs) const;
  // The largest radius of a sphere of a leaf [m].
  double max_radius_of(Index leaf) const;
  // The boxes of the features of a leaf for other places; returns the one around all of them.
  const SurfaceBox& refit_leaf(std::span<const Vec3> x, Index leaf) {
    fit_features(x, nodes_[leaves_[leaf]]);
    return nodes_[leaves_[leaf]].box;
  }
  // Appends the pairs that find_pairs examines, of two leaves with boxes for these places: some are not closer than `reach`. What is
  // `left_out` may be empty: nothing is.
  void find_pairs_of(const SurfacePlan& plan, Index first, Index second, double reach, std::span<const LeftOut> left_out,
                     PairsByKind& pairs) const {
    append_close(plan, nodes_[leaves_[first]], nodes_[leaves_[second]], reach, left_out, pairs);
  }

 private:
  // Its children are the next node and `second`; a leaf has none, and some pieces, with their own corners and edges.
  struct Node {
    SurfaceBox box;
    Index second = no_index;
    BoxRange pieces, corners, edges, leaves;
  };

  void split(std::span<const Vec3> center, Index first, Index end);
  void sort_features(const SurfacePlan& plan);
  void sort_points(const SurfacePlan& plan);
  void fit_features(std::span<const Vec3> x, Node& leaf);
  void fit_parents();
  void append_close(const SurfacePlan& plan, const Node& first, const Node& second, double reach, std::span<const LeftOut> left_out,
                    PairsByKind& pairs) const;
  static bool are_close(const SurfaceBox& a, const SurfaceBox& b, double reach);
  template <class Visit>
  void visit_leaves(double reach, const Visit& visit) const;

  std::vector<Node> nodes_;    // parents before their children
  std::vector<Index> leaves_;  // nodes

  // of the plan, those of a leaf together
  std::vector<Index> pieces_, corners_, edges_;
  std::vector<std::array<Index, 3>> piece_points_;
  std::vector<EdgeEnds> edge_ends_;
  std::vector<char> is_face_;     // per piece
  std::vector<char> is_on_face_;  // per corner
  std::vector<double> radius_;    // [m], per point of the plan, of spheres; empty: there are none
  BoxColumns piece_boxes_, corner_boxes_, edge_boxes_;
  std::vector<Index> leaf_points_, first_point_;
};

}  // namespace hooke
