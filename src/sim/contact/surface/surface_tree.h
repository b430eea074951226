// The broad phase of contact between faces and springs: a tree of bounding boxes over the pieces of a surface.
#pragma once

#include <vector>

#include "sim/contact/box_kernel.h"
#include "sim/contact/closest.h"
#include "sim/contact/surface/surface_plan.h"

namespace hooke {

// Two features with four points, and up to when they are certainly too far from each other to matter.
struct SurfacePair {
  FeaturePair kind = FeaturePair::PointFace;
  std::array<Index, 4> points{};
  bool has_spring = false;  // whether one of two edges is on no face
  double key = 0.0;         // [m], of SurfaceSolver
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
  // The boxes for other places, and for all on the way from there by a displacement of each point. Empty: none.
  void refit(const SurfacePlan& plan, std::span<const Vec3> x, std::span<const Vec3> displacement = {});

  // Appends the pairs of features that do not belong together, without those with points on both sides that are `left_out`, if they are
  // closer than `reach` [m], or may be on the way of their points by the displacements of `refit`. Pairs are found in an order that depends
  // on the last `build` alone: with a longer reach, others come in between. False if there would be more than max_pairs.
  bool find_pairs(const SurfacePlan& plan, std::span<const Vec3> x, double reach, std::span<const char> left_out,
                  std::vector<SurfacePair>& pairs, std::size_t max_pairs);
  // Pairs of leaves and of features that the last `find_pairs` examined.
  long examined() const { return examined_; }
  // Edges that pass through faces.
  Crossings find_crossings(const SurfacePlan& plan, std::span<const Vec3> x) const;

 private:
  struct Box {
    Vec3 min{0.0}, max{0.0};
    void include(const Box& other);
  };
  // Its children are the next node and `second`; a leaf has none, and some pieces, with their own corners and edges.
  struct Node {
    Box box;
    Index second = no_index;
    BoxRange pieces, corners, edges;
  };

  void split(std::span<const Vec3> center, Index first, Index end);
  void sort_features(const SurfacePlan& plan);
  Box box_of(std::span<const Index> points, std::span<const Vec3> x) const;
  void keep_close(std::span<const Vec3> x, double reach, std::size_t from, std::vector<SurfacePair>& pairs) const;
  static bool are_close(const Box& a, const Box& b, double reach);
  template <class Visit>
  void visit_leaves(double reach, const Visit& visit) const;

  long examined_ = 0;
  std::vector<Vec3> displacement_;                      // empty: none
  std::vector<Node> nodes_;                             // parents before their children
  std::vector<Index> pieces_, corners_, edges_;         // of the plan, those of a leaf together
  BoxColumns piece_boxes_, corner_boxes_, edge_boxes_;  // in that order
};

}  // namespace hooke
