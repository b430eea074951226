#include "sim/contact/surface/surface_sides.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace hooke {
namespace {

// Squares of the cosine between the normals of both faces: edges are thin up to 10 degrees, and thick from 25 degrees on.
constexpr double thin = 0.9698, thick = 0.8214;

bool same_pieces(const std::vector<SurfacePlan::Piece>& a, const std::vector<SurfacePlan::Piece>& b) {
  return std::ranges::equal(a, b, [](const auto& p, const auto& q) { return p.points == q.points && p.is_face == q.is_face; });
}

}  // namespace

void SurfaceSides::plan(const SurfacePlan& plan) {
  part_.assign(plan.edges.size(), 1.0);
  if (same_pieces(pieces_, plan.pieces) && edges_ == plan.edges) return;
  pieces_ = plan.pieces;
  edges_ = plan.edges;

  struct Side {
    EdgeEnds ends;
    Index opposite;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  owned_.assign(plan.pieces.size(), 0);
  for (std::size_t p = 0; p < plan.pieces.size(); ++p) {
    const SurfacePlan::Piece& piece = plan.pieces[p];
    if (!piece.is_face) continue;
    for (int c = 0; c < 3; ++c) {
      const EdgeEnds ends = edge_ends(piece.points[c], piece.points[(c + 1) % 3]);
      sides.push_back({ends, piece.points[(c + 2) % 3]});
      const auto own = std::span(plan.edges).subspan(piece.first_edge, static_cast<std::size_t>(piece.end_edge - piece.first_edge));
      const auto corners =
          std::span(plan.corners).subspan(piece.first_corner, static_cast<std::size_t>(piece.end_corner - piece.first_corner));
      if (std::ranges::find(own, ends) != own.end()) owned_[p] |= static_cast<unsigned char>(1U << static_cast<unsigned>(c));
      if (std::ranges::find(corners, piece.points[c]) != corners.end())
        owned_[p] |= static_cast<unsigned char>(8U << static_cast<unsigned>(c));
    }
  }
  std::ranges::sort(sides);
  opposite_.assign(plan.edges.size(), {no_index, no_index});
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const auto first = std::ranges::lower_bound(sides, plan.edges[e], {}, &Side::ends);
    const auto last = std::ranges::upper_bound(sides, plan.edges[e], {}, &Side::ends);
    if (last - first == 2) opposite_[e] = {first->opposite, (first + 1)->opposite};
  }
}

void SurfaceSides::find_bends(const SurfacePlan& plan, std::span<const Vec3> x, Index first, Index end) {
  for (Index e = first; e < end; ++e) {
    const auto [one, other] = opposite_[e];
    if (one == no_index) continue;
    const Vec3 from = x[plan.edges[e][0]], along = x[plan.edges[e][1]] - from;
    const Vec3 a = glm::cross(along, x[one] - from), b = glm::cross(x[other] - from, along);
    const double product = glm::dot(a, b), squares = glm::dot(a, a) * glm::dot(b, b);
    const double square = product > 0.0 && squares > 0.0 ? product * product / squares : 0.0;
    part_[e] = 1.0 - (1.0 - min_part) * std::clamp((square - thick) / (thin - thick), 0.0, 1.0);
  }
}

bool SurfaceSides::owns(Index piece, double at_first, double at_second, double at_third) const {
  const unsigned zeros = (at_first == 0.0 ? 1U : 0U) | (at_second == 0.0 ? 2U : 0U) | (at_third == 0.0 ? 4U : 0U);
  // bit of the side or corner on which it is: a side is opposite to the corner of weight zero
  constexpr std::array<unsigned char, 8> bit{0, 2, 4, 32, 1, 16, 8, 0};
  const unsigned char on = bit[zeros];
  return on == 0 || (owned_[piece] & on) != 0;
}

}  // namespace hooke
