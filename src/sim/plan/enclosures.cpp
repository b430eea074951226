#include "sim/plan/enclosures.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

#include "base/disjoint_sets.h"
#include "sim/plan/plan.h"
#include "sim/plan/rest_faces.h"

namespace hooke {
namespace {

// Of closed lines, the longest of which is the outer one.
bool add_line(const std::vector<EnclosureSide>& sides, EnclosurePlan& plan) {
  DisjointSets sets(sides.size());
  std::vector<std::pair<Index, Index>> ends;  // point, side
  for (std::size_t s = 0; s < sides.size(); ++s)
    for (int a = 0; a < 2; ++a) ends.emplace_back(sides[s].points[a], static_cast<Index>(s));
  std::ranges::sort(ends);
  for (std::size_t e = 1; e < ends.size(); ++e)
    if (ends[e].first == ends[e - 1].first) sets.join(ends[e].second, ends[e - 1].second);
  std::vector<double> length(sides.size(), 0.0);
  for (std::size_t s = 0; s < sides.size(); ++s) length[sets.root(static_cast<Index>(s))] += sides[s].size;
  // A = l^2 / (4 pi), less those of the holes
  double squares = 0.0, max = 0.0;
  for (const double l : length) {
    squares += l * l;
    max = std::max(max, l * l);
  }
  const double area = (2.0 * max - squares) / (4.0 * std::numbers::pi);
  if (!(area > 0.0)) return false;
  const auto begin = static_cast<Index>(plan.sides.size());
  plan.sides.insert(plan.sides.end(), sides.begin(), sides.end());
  plan.enclosures.push_back({begin, static_cast<Index>(plan.sides.size()), area});
  return true;
}

EnclosureSide side_of(const RestFace& face, bool is_flipped, double weight) {
  const auto& l = face.length;
  EnclosureSide side{.points = face.corners, .size = face.area, .weight = weight};
  for (int c = 0; c < 3; ++c) {
    const double a = l[(c + 1) % 3], b = l[(c + 2) % 3];
    side.median[c] = 0.5 * std::sqrt(std::max(0.0, 2.0 * a * a + 2.0 * b * b - l[c] * l[c]));
  }
  if (is_flipped) {
    std::swap(side.points[1], side.points[2]);
    std::swap(side.median[1], side.median[2]);
  }
  return side;
}

// The sets of faces that are connected by edges, in the order of their first faces.
class ConnectedFaces {
 public:
  explicit ConnectedFaces(const System& system) : system_(system), lengths_(system) {
    for (const Face& face : system.faces) faces_.push_back(rest_face(system, lengths_, face));
    edges_ = sorted_edges(system);
    is_flipped_.resize(faces_.size());
    connect();
  }

  void add_to(EnclosurePlan& plan) {
    for (const std::vector<Index>& surface : surfaces_) {
      const bool is_closed = system_.dimensions == 2 ? add_area(surface, plan) : add_volume(surface, plan);
      plan.open += is_closed ? 0 : 1;
    }
  }

 private:
  // Whether the face, as oriented so far, runs along the edge from its second point to its first.
  bool is_backward(const FaceEdge& edge) const { return (edge.from != edge.ends[0]) != is_flipped_[edge.face]; }

  // Finds the surfaces, and turns their faces so that two that share an edge run along it in opposite directions.
  void connect() {
    std::vector<std::array<const FaceEdge*, 6>> neighbors(faces_.size());  // pairs: own edge, that of the other face
    is_bad_.assign(faces_.size(), false);
    border_.assign(faces_.size(), {false, false, false});
    DisjointSets sets(faces_.size());
    for_each_edge(edges_, [&](std::span<const FaceEdge> same) {
      const FaceEdge &first = same.front(), &second = same.back();
      for (const FaceEdge& edge : same) sets.join(first.face, edge.face);
      if (same.size() == 1)
        border_[first.face][first.corner] = true;
      else if (same.size() > 2 || first.face == second.face)
        is_bad_[first.face] = true;
      else {
        neighbors[first.face][2 * first.corner] = neighbors[second.face][2 * second.corner + 1] = &first;
        neighbors[first.face][2 * first.corner + 1] = neighbors[second.face][2 * second.corner] = &second;
      }
    });

    std::vector<Index> surface_of(faces_.size(), no_index);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Index root = sets.root(static_cast<Index>(f));
      if (surface_of[root] == no_index) {
        surface_of[root] = static_cast<Index>(surfaces_.size());
        surfaces_.emplace_back();
      }
      surfaces_[surface_of[root]].push_back(static_cast<Index>(f));
    }

    std::vector<bool> is_turned(faces_.size(), false);
    std::vector<Index> stack;
    for (std::size_t start = 0; start < faces_.size(); ++start) {
      if (is_turned[start]) continue;
      is_turned[start] = true;
      stack.push_back(static_cast<Index>(start));
      while (!stack.empty()) {
        const Index f = stack.back();
        stack.pop_back();
        for (int c = 0; c < 3; ++c) {
          const FaceEdge *own = neighbors[f][2 * c], *other = neighbors[f][2 * c + 1];
          if (own == nullptr) continue;
          const bool agrees = is_backward(*own) != is_backward(*other);
          if (is_turned[other->face]) {
            is_bad_[f] = is_bad_[f] || !agrees;
            continue;
          }
          is_flipped_[other->face] = is_flipped_[other->face] != !agrees;
          is_turned[other->face] = true;
          stack.push_back(other->face);
        }
      }
    }
  }

  bool is_bad(const std::vector<Index>& surface) const {
    return std::ranges::any_of(surface, [&](Index f) { return is_bad_[f]; });
  }

  bool add_volume(const std::vector<Index>& surface, EnclosurePlan& plan) const {
    double area = 0.0;
    for (const Index f : surface) {
      if (std::ranges::find(border_[f], true) != border_[f].end() || faces_[f].area == 0.0) return false;
      area += faces_[f].area;
    }
    if (is_bad(surface)) return false;
    const auto begin = static_cast<Index>(plan.sides.size());
    for (std::size_t s = 0; s < surface.size(); ++s) {
      const Index f = surface[s];
      const auto add = [&](const RestFace& face, double weight) { plan.sides.push_back(side_of(face, is_flipped_[f], weight)); };
      std::array<RestFace, 2> others;
      if (system_.faces.is_quad(f)) {
        const auto [a, b, c, d] = system_.faces.quad(f);
        others = {rest_face(system_, lengths_, {{a, b, c}}), rest_face(system_, lengths_, {{c, d, a}})};
      }
      if (others[0].area == 0.0 || others[1].area == 0.0) {
        add(faces_[f], 1.0);
        continue;
      }
      // the mean of both diagonals
      for (const RestFace& face : {faces_[f], faces_[f + 1], others[0], others[1]}) add(face, 0.5);
      ++s;
    }
    // V = S^(3/2) / (6 sqrt(pi))
    plan.enclosures.push_back({begin, static_cast<Index>(plan.sides.size()), area * std::sqrt(area / std::numbers::pi) / 6.0});
    return true;
  }

  bool add_area(const std::vector<Index>& surface, EnclosurePlan& plan) const {
    if (is_bad(surface)) return false;
    std::vector<EnclosureSide> sides;
    for (const Index f : surface)
      for (int c = 0; c < 3; ++c) {
        if (!border_[f][c]) continue;
        Index i = faces_[f].corners[(c + 1) % 3], j = faces_[f].corners[(c + 2) % 3];
        if (is_flipped_[f]) std::swap(i, j);
        const double length = lengths_.between(i, j);
        if (length == 0.0) return false;
        sides.push_back({.points = {i, j, no_index}, .size = length});
      }
    return add_line(sides, plan);
  }

  const System& system_;
  RestLengths lengths_;
  std::vector<RestFace> faces_;
  std::vector<FaceEdge> edges_;
  std::vector<std::vector<Index>> surfaces_;  // of faces
  std::vector<bool> is_flipped_, is_bad_;     // bad: shares an edge with more than one other face, or cannot be turned
  std::vector<std::array<bool, 3>> border_;
};

// Springs without faces, where every point of a connected set has exactly two.
void add_rings(const System& system, EnclosurePlan& plan) {
  const auto points = static_cast<std::size_t>(system.point_count());
  struct Links {
    std::array<Index, 2> other{no_index, no_index};
    std::array<double, 2> length{};
    Index count = 0;
  };
  std::vector<Links> links(points);
  std::vector<bool> is_ring(points, true);
  for (const Face& face : system.faces)
    for (const PointId id : face.points) is_ring[system.index_of(id)] = false;
  DisjointSets sets(points);
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    sets.join(i, j);
    for (const auto& [from, to] : {std::pair{i, j}, std::pair{j, i}}) {
      Links& link = links[from];
      if (link.count < 2) {
        link.other[link.count] = to;
        link.length[link.count] = spring.rest_length;
      }
      ++link.count;
    }
  }
  for (std::size_t i = 0; i < points; ++i)
    if (links[i].count != 2 || links[i].other[0] == links[i].other[1]) is_ring[i] = false;
  for (std::size_t i = 0; i < points; ++i)
    if (!is_ring[i]) is_ring[sets.root(static_cast<Index>(i))] = false;

  for (std::size_t i = 0; i < points; ++i) {
    const auto first = static_cast<Index>(i);
    if (sets.root(first) != first || !is_ring[i]) continue;
    std::vector<EnclosureSide> sides;
    Index before = no_index, at = first;
    do {
      const int way = links[at].other[0] == before ? 1 : 0;
      const Index next = links[at].other[way];
      sides.push_back({.points = {at, next, no_index}, .size = links[at].length[way]});
      before = at;
      at = next;
    } while (at != first);
    add_line(sides, plan);
  }
}

void find_edges(EnclosurePlan& plan, int dimensions) {
  const auto ends_of = [&](const EnclosureSide& side, int c) {
    return dimensions == 2 ? edge_ends(side.points[0], side.points[1]) : edge_ends(side.points[(c + 1) % 3], side.points[(c + 2) % 3]);
  };
  const int count = dimensions == 2 ? 1 : 3;
  for (const EnclosureSide& side : plan.sides)
    for (int c = 0; c < count; ++c) plan.edges.push_back(ends_of(side, c));
  std::ranges::sort(plan.edges);
  plan.edges.erase(std::unique(plan.edges.begin(), plan.edges.end()), plan.edges.end());
  for (EnclosureSide& side : plan.sides)
    for (int c = 0; c < count; ++c)
      side.edge[c] = static_cast<Index>(std::ranges::lower_bound(plan.edges, ends_of(side, c)) - plan.edges.begin());
}

// The positions of the corners, from one of the enclosure on: far from the origin the sums would lose digits.
std::array<Vec3, 3> places_of(const Plan& plan, const Enclosure& enclosure, const EnclosureSide& side, const double* x) {
  const Vec3 origin = vector_at(plan, x, plan.force_data.enclosures.sides[enclosure.begin].points[0]);
  std::array<Vec3, 3> places{};
  for (int c = 0; c < plan.dimensions; ++c) places[c] = vector_at(plan, x, side.points[c]) - origin;
  return places;
}

}  // namespace

EnclosurePlan plan_enclosures(const System& system) {
  EnclosurePlan plan;
  ConnectedFaces(system).add_to(plan);
  if (system.dimensions == 2) add_rings(system, plan);
  find_edges(plan, system.dimensions);
  return plan;
}

// V = sum x_a.(x_b x x_c) / 6 of faces, A = sum (x_i y_j - x_j y_i) / 2 of edges
double signed_volume(const Plan& plan, const Enclosure& enclosure, const double* x) {
  const bool is_flat = plan.dimensions == 2;
  double sum = 0.0;
  for (Index s = enclosure.begin; s < enclosure.end; ++s) {
    const EnclosureSide& side = plan.force_data.enclosures.sides[s];
    const auto [a, b, c] = places_of(plan, enclosure, side, x);
    sum += is_flat ? glm::cross(a, b).z : side.weight * glm::dot(a, glm::cross(b, c));
  }
  return sum / (is_flat ? 2.0 : 6.0);
}

void add_volume_gradient(const Plan& plan, const Enclosure& enclosure, double scale, const double* x, double* f) {
  for (Index s = enclosure.begin; s < enclosure.end; ++s) {
    const EnclosureSide& side = plan.force_data.enclosures.sides[s];
    const std::array<Vec3, 3> p = places_of(plan, enclosure, side, x);
    if (plan.dimensions == 2) {
      add_vector(plan, f, side.points[0], 0.5 * scale * Vec3(p[1].y, -p[1].x, 0.0));
      add_vector(plan, f, side.points[1], 0.5 * scale * Vec3(-p[0].y, p[0].x, 0.0));
      continue;
    }
    for (int a = 0; a < 3; ++a) add_vector(plan, f, side.points[a], scale * side.weight / 6.0 * glm::cross(p[(a + 1) % 3], p[(a + 2) % 3]));
  }
}

}  // namespace hooke
