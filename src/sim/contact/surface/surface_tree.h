// The broad phase of contact between faces and springs: a tree of bounding boxes over the pieces of a surface.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/contact/box_kernel.h"
#include "sim/contact/closest.h"
#include "sim/plan/surface_plan.h"

namespace hooke {

// Two features with four points.
struct SurfacePair {
  FeaturePair kind = FeaturePair::PointFace;
  std::array<Index, 4> points{};
};

// Pairs of one kind, in columns.
struct SurfacePairs {
  std::vector<std::array<Index, 4>> points;
  std::vector<std::array<Index, 2>> features;  // of the plan: a piece and no_index, or two edges

  std::size_t size() const { return points.size(); }
  void resize(std::size_t count) { points.resize(count), features.resize(count); }
  void move(std::size_t from, std::size_t to) { points[to] = points[from], features[to] = features[from]; }
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

  // Points have moved to x.
  void refit(std::span<const Vec3> x);

  // Sets `pairs` to the pairs of features that do not belong together, without those with points on both sides that are `left_out`, if
  // they are closer than `reach` [m], and `distances` to theirs, of spheres from their surface. Pairs are found in an order that depends
  // on the last `build` alone: with a longer reach, others come in between. False if there would be more than max_pairs.
  bool find_pairs(const SurfacePlan& plan, std::span<const Vec3> x, double reach, std::span<const LeftOut> left_out, std::size_t max_pairs,
                  PairsByKind& pairs, std::array<std::vector<double>, 2>& distances) const;
  // The same, as one list.
  bool find_pairs(const SurfacePlan& plan, std::span<const Vec3> x, double reach, std::span<const LeftOut> left_out,
                  std::vector<SurfacePair>& pairs, std::size_t max_pairs) const;
  // Edges that pass through faces, without springs that others join to the face: they may pass its edges.
  Crossings find_crossings(const SurfacePlan& plan, std::span<const Vec3> x) const;

 private:
  // Its children are the next node and `second`; a leaf has none, and some pieces, with their own corners and edges.
  struct Node {
    SurfaceBox box;
    Index second = no_index;
    BoxRange pieces, corners, edges;
  };

  static constexpr Index pieces_per_leaf = 12, features_per_leaf = 3 * pieces_per_leaf;
  using ClosePairs = std::array<std::array<Index, 2>, static_cast<std::size_t>(features_per_leaf* features_per_leaf)>;
  static std::span<const std::array<Index, 2>> find_close(const BoxSet& first, const BoxSet& second, double reach, ClosePairs& room);

  void split(std::span<const Vec3> center, Index first, Index end);
  void sort_features(const SurfacePlan& plan);
  void fit_features(std::span<const Vec3> x, Node& leaf);
  void fit_parents();
  void append_close(const SurfacePlan& plan, const Node& first, const Node& second, double reach, std::span<const LeftOut> left_out,
                    PairsByKind& pairs) const;
  template <class Visit>
  void visit_leaves(double reach, const Visit& visit) const;

  std::vector<Node> nodes_;  // parents before their children

  // of the plan, those of a leaf together
  std::vector<Index> pieces_, corners_, edges_;
  std::vector<std::array<Index, 3>> piece_points_;
  std::vector<EdgeEnds> edge_ends_;
  std::vector<char> is_face_;     // per piece
  std::vector<char> is_on_face_;  // per corner
  std::vector<double> radius_;    // [m], per point of the plan, of spheres; empty: there are none
  SurfaceBoxes piece_boxes_, corner_boxes_, edge_boxes_;
};

}  // namespace hooke
