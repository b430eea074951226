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

// [m^2]
inline double square_of_distance(const SurfaceBox& a, const SurfaceBox& b) {
  double sum = 0.0;
  for (int c = 0; c < 3; ++c) {
    const double gap = std::max(0.0, std::max(a.min[c] - b.max[c], b.min[c] - a.max[c]));
    sum += gap * gap;
  }
  return sum;
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

std::span<const std::array<Index, 2>> SurfaceTree::find_close(const BoxSet& first, const BoxSet& second, double reach, ClosePairs& room) {
  return std::span(room).first(find_close_boxes(first, second, reach, room));
}

void SurfaceTree::build(const SurfacePlan& plan, std::span<const Vec3> x) {
  const auto n = static_cast<Index>(plan.pieces.size());
  std::vector<Vec3> center;
  center.reserve(n);
  pieces_.clear();
  for (Index p = 0; p < n; ++p) {
    const auto& corner = plan.pieces[p].points;
    center.push_back(x[corner[0]] + x[corner[1]] + x[corner[2]]);
    // coordinates near the limit of numbers are not sorted
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(center[p][c])) center[p][c] = 0.0;
    pieces_.push_back(p);
  }
  nodes_.clear();
  split(center, 0, n);
  sort_features(plan);
  radius_ = plan.radius;
  refit(x);
}

void SurfaceTree::refit(std::span<const Vec3> x) {
  for (Node& node : nodes_)
    if (node.second == no_index) fit_features(x, node);
  fit_parents();
}

// In halves along the longest axis.
void SurfaceTree::split(std::span<const Vec3> center, Index first, Index end) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({.pieces = {first, end}});
  const auto at = [&](Index position) { return pieces_.begin() + position; };
  if (end - first <= pieces_per_leaf) {
    std::sort(at(first), at(end));
    return;
  }
  SurfaceBox box{center[pieces_[first]], center[pieces_[first]]};
  for (Index p = first; p < end; ++p) box.include({center[pieces_[p]], center[pieces_[p]]});
  const Vec3 size = box.max - box.min;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const Index middle = first + (end - first) / 2;
  std::nth_element(at(first), at(middle), at(end), [&](Index a, Index b) {
    return std::pair{center[a][axis], a} < std::pair{center[b][axis], b};
  });
  split(center, first, middle);
  nodes_[node].second = static_cast<Index>(nodes_.size());
  split(center, middle, end);
}

void SurfaceTree::sort_features(const SurfacePlan& plan) {
  corners_.clear();
  is_on_face_.clear();
  edges_.clear();
  for (Node& node : nodes_) {
    if (node.second != no_index) continue;
    node.corners.begin = static_cast<Index>(corners_.size());
    node.edges.begin = static_cast<Index>(edges_.size());
    for (Index p = node.pieces.begin; p < node.pieces.end; ++p) {
      const SurfacePiece& piece = plan.pieces[pieces_[p]];
      for (Index c = piece.first_corner; c < piece.end_corner; ++c) {
        corners_.push_back(plan.corners[c]);
        is_on_face_.push_back(piece.is_face ? 1 : 0);  // a face owns all its points that are on springs as well
      }
      for (Index e = piece.first_edge; e < piece.end_edge; ++e) edges_.push_back(e);
    }
    node.corners.end = static_cast<Index>(corners_.size());
    node.edges.end = static_cast<Index>(edges_.size());
  }
  piece_points_.clear();
  is_face_.clear();
  for (const Index p : pieces_) {
    piece_points_.push_back(plan.pieces[p].points);
    is_face_.push_back(plan.pieces[p].is_face ? 1 : 0);
  }
  edge_ends_.clear();
  for (const Index e : edges_) edge_ends_.push_back(plan.edges[e]);

  corner_boxes_.resize(corners_.size());
  piece_boxes_.resize(pieces_.size());
  edge_boxes_.resize(edges_.size());
}

// Boxes of spheres are around all of them.
void SurfaceTree::fit_features(std::span<const Vec3> x, Node& leaf) {
  const auto box_of_point = [&](Index i) {
    const Vec3 radius(radius_.empty() ? 0.0 : radius_[i]);
    return SurfaceBox{x[i] - radius, x[i] + radius};
  };
  for (Index c = leaf.corners.begin; c < leaf.corners.end; ++c) corner_boxes_.set(c, box_of_point(corners_[c]));
  const auto box_of_edge = [&](Index i, Index j) {
    SurfaceBox box = box_of_point(i);
    box.include({x[j], x[j]});
    return box;
  };
  for (Index e = leaf.edges.begin; e < leaf.edges.end; ++e) edge_boxes_.set(e, box_of_edge(edge_ends_[e][0], edge_ends_[e][1]));
  for (Index p = leaf.pieces.begin; p < leaf.pieces.end; ++p) {
    const auto [i, j, k] = piece_points_[p];
    SurfaceBox box = box_of_edge(i, j);
    box.include({x[k], x[k]});
    piece_boxes_.set(p, box);
    if (p == leaf.pieces.begin) leaf.box = box;
    leaf.box.include(box);
  }
}

void SurfaceTree::fit_parents() {
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    if (node.second == no_index) continue;
    node.box = nodes_[i + 1].box;
    node.box.include(nodes_[node.second].box);
  }
}

// Calls visit(a, b) for the leaves whose boxes are close to each other; stops when it returns false.
template <class Visit>
void SurfaceTree::visit_leaves(double reach, const Visit& visit) const {
  // at most three for each level of the tree of both
  std::array<std::array<Index, 2>, 256> open;
  std::size_t count = 0;
  const auto push = [&](Index a, Index b) { open[count++] = {a, b}; };
  push(0, 0);
  while (count > 0) {
    const auto [a, b] = open[--count];
    const Node &first = nodes_[a], &second = nodes_[b];
    if (a == b && first.second != no_index) {
      push(first.second, first.second);
      push(a + 1, first.second);
      push(a + 1, a + 1);
      continue;
    }
    if (a != b) {
      if (square_of_distance(first.box, second.box) > reach * reach * (1.0 + 1e-12)) continue;
      // halves the one with more pieces
      const auto size = [](const Node& node) { return node.pieces.end - node.pieces.begin; };
      const bool splits_first = first.second != no_index && (second.second == no_index || size(first) >= size(second));
      if (splits_first || second.second != no_index) {
        push(splits_first ? first.second : a, splits_first ? b : second.second);
        push(splits_first ? a + 1 : a, splits_first ? b : b + 1);
        continue;
      }
    }
    if (!visit(first, second)) return;
  }
}

// Those whose boxes are closer than `reach`.
void SurfaceTree::append_close(const SurfacePlan& plan, const Node& first, const Node& second, double reach,
                               std::span<const LeftOut> left_out, PairsByKind& pairs) const {
  ClosePairs room;
  const auto is_out = [&](bool has_spring, std::span<const Index> points) {
    const LeftOut least = has_spring ? LeftOut::Springs : LeftOut::All;
    return !left_out.empty() && std::ranges::any_of(points, [&](Index i) { return left_out[i] >= least; });
  };
  const auto append = [&](FeaturePair kind, const std::array<Index, 4>& points, const std::array<Index, 2>& features) {
    SurfacePairs& to = pairs[static_cast<std::size_t>(kind)];
    to.points.push_back(points);
    to.features.push_back(features);
  };
  const auto add_points = [&](const Node& of_corners, const Node& of_pieces) {
    for (const auto& [c, p] :
         find_close({corner_boxes_, of_corners.corners, of_corners.box}, {piece_boxes_, of_pieces.pieces, of_pieces.box}, reach, room)) {
      const std::array corner{corners_[c]};
      const auto& face = piece_points_[p];
      if (is_face_[p] == 0 || share_point(corner, face) || (!plan.close.empty() && plan.excludes_face(corner[0], face))) continue;
      if (is_out(is_on_face_[c] == 0, corner) && is_out(is_on_face_[c] == 0, face)) continue;
      append(FeaturePair::PointFace, {corner[0], face[0], face[1], face[2]}, {pieces_[p], no_index});
    }
  };
  add_points(first, second);
  if (&first != &second) add_points(second, first);

  const bool has_links = !plan.close.empty() || !plan.joined.empty() || !plan.radius.empty();
  for (const auto& [e, f] : find_close({edge_boxes_, first.edges, first.box}, {edge_boxes_, second.edges, second.box}, reach, room)) {
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
                             std::size_t max_pairs, PairsByKind& pairs, std::array<std::vector<double>, 2>& distances) const {
  for (SurfacePairs& each : pairs) each.resize(0);
  for (std::vector<double>& each : distances) each.clear();
  if (nodes_.empty()) return true;
  // those that were found last, without those that are too far apart
  std::array<std::size_t, 2> measured{};
  const auto measure = [&](FeaturePair kind) {
    const auto k = static_cast<std::size_t>(kind);
    SurfacePairs& found = pairs[k];
    std::size_t end = measured[k];
    distances[k].resize(found.size());
    find_distances(kind, x, std::span(found.points).subspan(end), std::span(distances[k]).subspan(end));
    for (std::size_t p = end; p < found.size(); ++p) {
      const double distance = distances[k][p] - plan.radius_of(found.points[p]);
      found.move(p, end);
      distances[k][end] = distance;
      end += static_cast<std::size_t>(distance < reach);
    }
    found.resize(end);
    distances[k].resize(end);
    measured[k] = end;
  };
  constexpr std::size_t batch = 4096;
  visit_leaves(reach, [&](const Node& first, const Node& second) {
    append_close(plan, first, second, reach, left_out, pairs);
    for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges})
      if (const auto k = static_cast<std::size_t>(kind); pairs[k].size() > measured[k] + batch) measure(kind);
    return measured[0] + measured[1] <= max_pairs;
  });
  for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges}) measure(kind);
  return measured[0] + measured[1] <= max_pairs;
}

bool SurfaceTree::find_pairs(const SurfacePlan& plan, std::span<const Vec3> x, double reach, std::span<const LeftOut> left_out,
                             std::vector<SurfacePair>& pairs, std::size_t max_pairs) const {
  PairsByKind found;
  std::array<std::vector<double>, 2> distances;
  const bool is_complete = find_pairs(plan, x, reach, left_out, max_pairs, found, distances);
  for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges}) {
    const SurfacePairs& of_kind = found[static_cast<std::size_t>(kind)];
    for (const auto& points : of_kind.points) pairs.push_back({kind, points});
  }
  return is_complete;
}

Crossings SurfaceTree::find_crossings(const SurfacePlan& plan, std::span<const Vec3> x) const {
  Crossings crossings;
  if (nodes_.empty()) return crossings;
  constexpr std::size_t max_tests = 20'000'000;
  std::size_t tests = 0;
  ClosePairs room;
  const auto test = [&](const Node& of_edges, const Node& of_pieces) {
    const auto close = find_close({edge_boxes_, of_edges.edges, of_edges.box}, {piece_boxes_, of_pieces.pieces, of_pieces.box}, 0.0, room);
    for (const auto& [i, p] : close) {
      const auto [j, k] = edge_ends_[i];
      const auto [a, b, c] = piece_points_[p];
      if (is_face_[p] != 0 && !share_point(edge_ends_[i], piece_points_[p]) && passes_through(x[j], x[k], x[a], x[b], x[c]) &&
          !(plan.is_spring[edges_[i]] != 0 && are_joined(plan, edge_ends_[i], piece_points_[p])))
        crossings.found.push_back({edges_[i], pieces_[p]});
    }
    tests += close.size();
  };
  visit_leaves(0.0, [&](const Node& first, const Node& second) {
    test(first, second);
    if (&first != &second) test(second, first);
    crossings.is_complete = tests < max_tests;
    return crossings.is_complete;
  });
  return crossings;
}

}  // namespace hooke
