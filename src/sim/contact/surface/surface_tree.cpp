#include "sim/contact/surface/surface_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace hooke {
namespace {

double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return glm::dot(glm::cross(b - a, c - a), d - a); }

double max_component(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// Whether the edge from p to q passes through the triangle. What is in its plane up to rounding, such as a neighbor in a flat sheet, does
// not.
bool passes_through(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double from = volume(a, b, c, p), to = volume(a, b, c, q);
  if ((from >= 0.0 && to >= 0.0) || (from <= 0.0 && to <= 0.0)) return false;
  const double size = std::max({max_component(b - a), max_component(c - a), max_component(p - a), max_component(q - a)});
  const double round_off = 1e-14 * size * size * (size + max_component(a));
  if (std::abs(from) <= round_off || std::abs(to) <= round_off) return false;
  const double u = volume(p, q, a, b), v = volume(p, q, b, c), w = volume(p, q, c, a);
  return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
}

// Whether two features have a point in common.
bool share_point(std::span<const Index> first, std::span<const Index> second) {
  return std::ranges::any_of(first, [&](Index i) { return std::ranges::find(second, i) != second.end(); });
}

// Whether any spring joins a point of one to one of the other.
bool are_joined(const SurfacePlan& plan, const EdgeEnds& edge, std::span<const Index> face) {
  return std::ranges::any_of(edge, [&](Index i) {
    return std::ranges::any_of(face, [&](Index j) { return std::ranges::binary_search(plan.joined, edge_ends(i, j)); });
  });
}

// Around these points. That of a sphere is around all of it.
SurfaceBox box_of(const SurfacePlan& plan, std::span<const Vec3> x, std::span<const Index> points) {
  const Vec3 radius(plan.radius.empty() ? 0.0 : plan.radius[points[0]]);
  SurfaceBox box{x[points[0]] - radius, x[points[0]] + radius};
  for (const Index i : points.subspan(1)) box.include({x[i], x[i]});
  return box;
}

// Whether one of these points is left out of pairs of a face, or of those that are on no face.
bool is_out(std::span<const LeftOut> left_out, bool has_spring, std::span<const Index> points) {
  const LeftOut least = has_spring ? LeftOut::Springs : LeftOut::All;
  return !left_out.empty() && std::ranges::any_of(points, [&](Index i) { return left_out[i] >= least; });
}

}  // namespace

void SurfaceTree::build(const SurfacePlan& plan, std::span<const Vec3> x) {
  std::vector<Vec3> places;
  for (const SurfacePiece& piece : plan.pieces) places.push_back(x[piece.points[0]] + x[piece.points[1]] + x[piece.points[2]]);
  tree_.build(places);
  boxes_.resize(plan.pieces.size());
  refit(plan, x);
}

void SurfaceTree::refit(const SurfacePlan& plan, std::span<const Vec3> x) {
  for (std::size_t p = 0; p < boxes_.size(); ++p) boxes_[p] = box_of(plan, x, plan.pieces[tree_.order()[p]].points);
  tree_.fit([&](const BoxRange& pieces) {
    SurfaceBox all = boxes_[pieces.begin];
    for (Index p = pieces.begin; p < pieces.end; ++p) all.include(boxes_[p]);
    return all;
  });
}

// Calls use(p, close) for each piece of the first leaf, with those of the second whose boxes are within `reach` of its own: places in the
// order of the tree.
template <class Use>
void SurfaceTree::for_close_pieces(const Node& first, const Node& second, double reach, const Use& use) const {
  std::array<Index, BoxTree::max_per_leaf> close;
  for (Index p = first.items.begin; p < first.items.end; ++p) {
    if (!are_close(boxes_[p], second.box, reach)) continue;
    std::size_t count = 0;
    for (Index q = second.items.begin; q < second.items.end; ++q) {
      close[count] = q;
      count += are_close(boxes_[p], boxes_[q], reach) ? 1U : 0U;
    }
    use(p, std::span<const Index>(close).first(count));
  }
}

// The points of a piece and the faces that are close to them.
void SurfaceTree::append_corners(const Search& search, Index piece, std::span<const Index> close, SurfacePairs& pairs) const {
  const auto& [plan, x, reach, left_out] = search;
  const SurfacePiece& own = plan.pieces[tree_.order()[piece]];
  for (Index c = own.first_corner; c < own.end_corner; ++c) {
    const std::array corner{plan.corners[c]};
    const SurfaceBox box = box_of(plan, x, corner);
    for (const Index q : close) {
      const Index face = tree_.order()[q];
      const auto& points = plan.pieces[face].points;
      if (!plan.pieces[face].is_face || !are_close(box, boxes_[q], reach)) continue;
      if (share_point(corner, points) || (!plan.close.empty() && plan.excludes_face(corner[0], points))) continue;
      // a face owns all its points that are on springs as well
      if (is_out(left_out, !own.is_face, corner) && is_out(left_out, !own.is_face, points)) continue;
      pairs[0].push_back({FeaturePair::PointFace, {corner[0], points[0], points[1], points[2]}, {face, no_index}});
    }
  }
}

// The edges of a piece and those of other pieces that are close to them.
void SurfaceTree::append_edges(const Search& search, Index piece, std::span<const Index> close, SurfacePairs& pairs) const {
  const auto& [plan, x, reach, left_out] = search;
  const SurfacePiece& own = plan.pieces[tree_.order()[piece]];
  const bool has_links = !plan.close.empty() || !plan.joined.empty() || !plan.radius.empty();
  for (Index e = own.first_edge; e < own.end_edge; ++e) {
    const EdgeEnds& one = plan.edges[e];
    const SurfaceBox box = box_of(plan, x, one);
    for (const Index q : close) {
      const SurfacePiece& with = plan.pieces[tree_.order()[q]];
      for (Index f = with.first_edge; f < with.end_edge; ++f) {
        const EdgeEnds& other = plan.edges[f];
        if (!are_close(box, box_of(plan, x, other), reach)) continue;
        const bool has_spring = (plan.is_spring[e] | plan.is_spring[f]) != 0;
        if (share_point(one, other) || (has_links && plan.excludes_edge(e, f))) continue;
        if (is_out(left_out, has_spring, one) && is_out(left_out, has_spring, other)) continue;
        // spheres first
        const bool is_sphere = other[0] == other[1];
        const EdgeEnds &a = is_sphere ? other : one, &b = is_sphere ? one : other;
        pairs[1].push_back({FeaturePair::TwoEdges, {a[0], a[1], b[0], b[1]}, {e, f}});
      }
    }
  }
}

void SurfaceTree::append_close(const Search& search, const Node& first, const Node& second, SurfacePairs& pairs) const {
  const bool is_same = &first == &second;
  for_close_pieces(first, second, search.reach, [&](Index p, std::span<const Index> close) {
    append_corners(search, p, close, pairs);
    // the edges of a face share points
    if (is_same) close = {std::ranges::upper_bound(close, p), close.end()};
    append_edges(search, p, close, pairs);
  });
  if (!is_same)
    for_close_pieces(second, first, search.reach, [&](Index p, std::span<const Index> close) { append_corners(search, p, close, pairs); });
}

bool SurfaceTree::find_pairs(const SurfacePlan& plan, std::span<const Vec3> x, double reach, std::span<const LeftOut> left_out,
                             std::size_t max_pairs, SurfacePairs& pairs) const {
  for (std::vector<SurfacePair>& each : pairs) each.clear();
  // those that were found last, without those that are too far apart
  FeatureBlock block;
  std::array<std::size_t, 2> measured{};
  const auto measure = [&](FeaturePair kind) {
    std::vector<SurfacePair>& found = pairs[static_cast<std::size_t>(kind)];
    std::size_t& end = measured[static_cast<std::size_t>(kind)];
    for (std::size_t from = end; from < found.size(); from += static_cast<std::size_t>(block.count)) {
      block.count = static_cast<int>(std::min<std::size_t>(FeatureBlock::capacity, found.size() - from));
      for (int i = 0; i < block.count; ++i) block.points[i] = found[from + static_cast<std::size_t>(i)].points;
      find_closest(kind, x, block);
      for (int i = 0; i < block.count; ++i) {
        SurfacePair pair = found[from + static_cast<std::size_t>(i)];
        pair.distance = block.distance[i] - plan.radius_of(pair.points);
        found[end] = pair;
        end += static_cast<std::size_t>(pair.distance < reach);
      }
    }
    found.resize(end);
  };
  constexpr std::size_t batch = 4096;
  tree_.visit_close(reach, [&](const Node& first, const Node& second) {
    append_close({plan, x, reach, left_out}, first, second, pairs);
    for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges})
      if (const auto k = static_cast<std::size_t>(kind); pairs[k].size() > measured[k] + batch) measure(kind);
    return measured[0] + measured[1] <= max_pairs;
  });
  for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges}) measure(kind);
  return measured[0] + measured[1] <= max_pairs;
}

Crossings SurfaceTree::find_crossings(const SurfacePlan& plan, std::span<const Vec3> x) const {
  Crossings crossings;
  constexpr std::size_t max_tests = 20'000'000;
  std::size_t tests = 0;
  const auto test_edges = [&](Index piece, std::span<const Index> close) {
    const SurfacePiece& own = plan.pieces[tree_.order()[piece]];
    for (Index e = own.first_edge; e < own.end_edge; ++e) {
      const EdgeEnds& ends = plan.edges[e];
      const SurfaceBox box = box_of(plan, x, ends);
      for (const Index q : close) {
        if (!are_close(box, boxes_[q], 0.0)) continue;
        ++tests;
        const Index face = tree_.order()[q];
        const auto& points = plan.pieces[face].points;
        if (plan.pieces[face].is_face && !share_point(ends, points) &&
            passes_through(x[ends[0]], x[ends[1]], x[points[0]], x[points[1]], x[points[2]]) &&
            !(plan.is_spring[e] != 0 && are_joined(plan, ends, points)))
          crossings.found.push_back({e, face});
      }
    }
  };
  tree_.visit_close(0.0, [&](const Node& first, const Node& second) {
    for_close_pieces(first, second, 0.0, test_edges);
    if (&first != &second) for_close_pieces(second, first, 0.0, test_edges);
    crossings.is_complete = tests < max_tests;
    return crossings.is_complete;
  });
  return crossings;
}

}  // namespace hooke
