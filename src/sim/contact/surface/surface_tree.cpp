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

}  // namespace

BoxSet SurfaceTree::boxes_of(Feature feature, const Node& leaf) const {
  const auto [first, end] = leaf.items;
  const BoxRange range = feature == Piece    ? leaf.items
                         : feature == Corner ? BoxRange{first_corner_[first], first_corner_[end]}
                                             : BoxRange{first_edge_[first], first_edge_[end]};
  return {boxes_[feature], range, leaf.box};
}

std::span<const std::array<Index, 2>> SurfaceTree::find_close(const BoxSet& first, const BoxSet& second, double reach,
                                                              ClosePairs& room) const {
  return std::span(room).first(find_close_boxes(first, second, reach, room));
}

void SurfaceTree::build(const SurfacePlan& plan, std::span<const Vec3> x) {
  std::vector<Vec3> places;
  for (const SurfacePiece& piece : plan.pieces) places.push_back(x[piece.points[0]] + x[piece.points[1]] + x[piece.points[2]]);
  tree_.build(places);
  for (auto* list : {&corners_, &edges_, &first_corner_, &first_edge_}) list->clear();
  piece_points_.clear();
  edge_ends_.clear();
  is_face_.clear();
  is_on_face_.clear();
  const auto begin_piece = [&] {
    first_corner_.push_back(static_cast<Index>(corners_.size()));
    first_edge_.push_back(static_cast<Index>(edges_.size()));
  };
  for (const Index p : tree_.order()) {
    const SurfacePiece& piece = plan.pieces[p];
    begin_piece();
    piece_points_.push_back(piece.points);
    is_face_.push_back(piece.is_face ? 1 : 0);
    for (Index c = piece.first_corner; c < piece.end_corner; ++c) {
      corners_.push_back(plan.corners[c]);
      is_on_face_.push_back(piece.is_face ? 1 : 0);  // a face owns all its points that are on springs as well
    }
    for (Index e = piece.first_edge; e < piece.end_edge; ++e) {
      edges_.push_back(e);
      edge_ends_.push_back(plan.edges[e]);
    }
  }
  begin_piece();
  boxes_[Piece].resize(piece_points_.size());
  boxes_[Corner].resize(corners_.size());
  boxes_[Edge].resize(edges_.size());
  radius_ = plan.radius;
  refit(x);
}

void SurfaceTree::refit(std::span<const Vec3> x) {
  tree_.fit([&](const BoxRange& pieces) { return fit_features(x, pieces); });
}

// Of a leaf. Boxes of spheres are around all of them.
SurfaceBox SurfaceTree::fit_features(std::span<const Vec3> x, const BoxRange& pieces) {
  const auto box_of_point = [&](Index i) {
    const Vec3 radius(radius_.empty() ? 0.0 : radius_[i]);
    return SurfaceBox{x[i] - radius, x[i] + radius};
  };
  const auto box_of_edge = [&](Index i, Index j) {
    SurfaceBox box = box_of_point(i);
    box.include({x[j], x[j]});
    return box;
  };
  for (Index c = first_corner_[pieces.begin]; c < first_corner_[pieces.end]; ++c) boxes_[Corner].set(c, box_of_point(corners_[c]));
  for (Index e = first_edge_[pieces.begin]; e < first_edge_[pieces.end]; ++e)
    boxes_[Edge].set(e, box_of_edge(edge_ends_[e][0], edge_ends_[e][1]));
  SurfaceBox all;
  for (Index p = pieces.begin; p < pieces.end; ++p) {
    const auto [i, j, k] = piece_points_[p];
    SurfaceBox box = box_of_edge(i, j);
    box.include({x[k], x[k]});
    boxes_[Piece].set(p, box);
    if (p == pieces.begin) all = box;
    all.include(box);
  }
  return all;
}

// Those whose boxes are closer than `reach`.
void SurfaceTree::append_close(const SurfacePlan& plan, const Node& first, const Node& second, double reach,
                               std::span<const LeftOut> left_out, SurfacePairs& pairs) const {
  ClosePairs room;
  const auto is_out = [&](bool has_spring, std::span<const Index> points) {
    const LeftOut least = has_spring ? LeftOut::Springs : LeftOut::All;
    return !left_out.empty() && std::ranges::any_of(points, [&](Index i) { return left_out[i] >= least; });
  };
  const auto append = [&](FeaturePair kind, const std::array<Index, 4>& points, const std::array<Index, 2>& features) {
    pairs[static_cast<std::size_t>(kind)].push_back({kind, points, features});
  };
  const auto add_points = [&](const Node& of_corners, const Node& of_pieces) {
    for (const auto& [c, p] : find_close(boxes_of(Corner, of_corners), boxes_of(Piece, of_pieces), reach, room)) {
      const std::array corner{corners_[c]};
      const auto& face = piece_points_[p];
      if (is_face_[p] == 0 || share_point(corner, face) || (!plan.close.empty() && plan.excludes_face(corner[0], face))) continue;
      if (is_out(is_on_face_[c] == 0, corner) && is_out(is_on_face_[c] == 0, face)) continue;
      append(FeaturePair::PointFace, {corner[0], face[0], face[1], face[2]}, {tree_.order()[p], no_index});
    }
  };
  add_points(first, second);
  if (&first != &second) add_points(second, first);

  const bool has_links = !plan.close.empty() || !plan.joined.empty() || !plan.radius.empty();
  for (const auto& [e, f] : find_close(boxes_of(Edge, first), boxes_of(Edge, second), reach, room)) {
    const EdgeEnds &one = edge_ends_[e], &other = edge_ends_[f];
    const bool has_spring = (plan.is_spring[edges_[e]] | plan.is_spring[edges_[f]]) != 0;
    if (share_point(one, other) || (has_links && plan.excludes_edge(edges_[e], edges_[f]))) continue;
    if (is_out(has_spring, one) && is_out(has_spring, other)) continue;
    // spheres first
    const bool is_sphere = other[0] == other[1];
    const EdgeEnds &a = is_sphere ? other : one, &b = is_sphere ? one : other;
    append(FeaturePair::TwoEdges, {a[0], a[1], b[0], b[1]}, {edges_[e], edges_[f]});
  }
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
    append_close(plan, first, second, reach, left_out, pairs);
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
  ClosePairs room;
  const auto test = [&](const Node& of_edges, const Node& of_pieces) {
    const auto close = find_close(boxes_of(Edge, of_edges), boxes_of(Piece, of_pieces), 0.0, room);
    for (const auto& [i, p] : close) {
      const auto [j, k] = edge_ends_[i];
      const auto [a, b, c] = piece_points_[p];
      if (is_face_[p] != 0 && !share_point(edge_ends_[i], piece_points_[p]) && passes_through(x[j], x[k], x[a], x[b], x[c]) &&
          !(plan.is_spring[edges_[i]] != 0 && are_joined(plan, edge_ends_[i], piece_points_[p])))
        crossings.found.push_back({edges_[i], tree_.order()[p]});
    }
    tests += close.size();
  };
  tree_.visit_close(0.0, [&](const Node& first, const Node& second) {
    test(first, second);
    if (&first != &second) test(second, first);
    crossings.is_complete = tests < max_tests;
    return crossings.is_complete;
  });
  return crossings;
}

}  // namespace hooke
