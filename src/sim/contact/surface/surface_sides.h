// How much edges of a surface are bent, and which of the features that faces share belong to which of them.
#pragma once

#include <span>
#include <vector>

#include "sim/plan/surface_plan.h"

namespace hooke {

// Where a surface is flat, its points keep it apart from others: edges need to do so only where it is bent. So between two faces with
// nearly the same normal they are thin.
class SurfaceSides {
 public:
  void plan(const SurfacePlan& plan);
  // Of the edges from `first` to `end`, for points at x.
  void find_bends(const SurfacePlan& plan, std::span<const Vec3> x, Index first, Index end);
  // The part of the thickness that an edge has, from min_part to 1.
  double part(Index edge) const { return part_[edge]; }
  static constexpr double min_part = 0.25;
  // Whether the point at which a face is closest to another point, by its weights there, belongs to it: inside, or on an edge or corner
  // that no face before it has. Otherwise another face is as close.
  bool owns(Index piece, double at_first, double at_second, double at_third) const;

 private:
  std::vector<SurfacePlan::Piece> pieces_;  // for which the following is known
  std::vector<EdgeEnds> edges_;
  std::vector<std::array<Index, 2>> opposite_;  // per edge, of two faces; no_index: there are not two
  std::vector<unsigned char> owned_;            // per piece: bits of its sides and of its corners
  std::vector<double> part_;
};

}  // namespace hooke
