#include "study/check/finer_network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "sim/plan/grid.h"
#include "sim/plan/plan.h"
#include "sim/step/divergence.h"

namespace hooke {
namespace {

// Of a spring, as if many of them lay side by side.
struct Strength {
  double k = 0.0, d = 0.0, length = 0.0, weight = 0.0;  // length: sum of weight times rest length
  double break_strain = never_breaks;
  SpringFamily family = SpringFamily::None;
  void add(const Spring& spring, double fraction) {
    const double share = fraction * (spring.stiffness > 0.0 ? spring.stiffness : spring.damping > 0.0 ? spring.damping : 1.0);
    k += fraction * spring.stiffness;
    d += fraction * spring.damping;
    length += share * spring.rest_length;
    weight += share;
    break_strain = std::min(break_strain, spring.break_strain);
    family = spring.family;
  }
};

// Fractions of a spring's k for each of the two springs on its line, and for those on the line between it and a neighbor on each side.
struct Fractions {
  double line = 2.0, side = 0.0;
};

// The refined grid: (r, c) of the original is at (2 r, 2 c).
struct Fine {
  explicit Fine(const Grid& of) : grid(&of), rows(2 * of.rows - 1), columns(2 * of.columns - 1) {}
  Index at(Index r, Index c) const { return first + r * columns + c; }
  const Grid* grid;
  Index rows, columns;
  Index first = 0;  // index of its first point
};

class NetworkRefinement {
 public:
  NetworkRefinement(const System& system, const State& state) : system_(system), state_(state) {}

  std::optional<FinerNetwork> run(Index max_points) {
    find_grids_of_springs();
    if (fine_.empty() || !std::ranges::all_of(system_.points(), &Point::is_plain) || system_.springs().have_laws()) return std::nullopt;
    place_points();
    if (points_.size() > static_cast<std::size_t>(max_points)) return std::nullopt;
    for (const Fine& fine : fine_) {
      add_masses(fine);
      add_lines(fine, 1, 0, 1, [&](Index r, Index c) { return at(*fine.grid, Grid::Right, r, c); });
      add_lines(fine, 1, 1, 0, [&](Index r, Index c) { return at(*fine.grid, Grid::Down, r, c); });
      add_diagonals(fine);
    }
    add_bends();
    add_other_springs();
    return finish();
  }

 private:
  void find_grids_of_springs() {
    std::vector<SpringRun> runs, rest;
    const Index count = system_.spring_count();
    for (Index s = 0; s < count; ++s) {
      Index i = system_.index_of(spring(s).first), j = system_.index_of(spring(s).second);
      if (i > j) std::swap(i, j);
      runs.push_back({.begin = s, .first = i, .second = j, .count = 1});
    }
    grids_ = find_grids(runs, system_.point_count(), rest);
    std::erase_if(grids_, [&](const Grid& grid) { return is_part_of_more(grid, rest); });
    grid_of_.assign(static_cast<std::size_t>(system_.point_count()), -1);
    is_in_grid_.assign(static_cast<std::size_t>(count), false);
    for (const Grid& grid : grids_) {
      std::fill_n(grid_of_.begin() + grid.first, grid.points(), static_cast<int>(fine_.size()));
      for (const auto& springs : grid.spring)
        for (const Index s : springs)
          if (s != no_index) is_in_grid_[s] = true;
      fine_.emplace_back(grid);
    }
  }

  // Whether more than a quarter of the points have other springs too, as in trusses and lattices.
  bool is_part_of_more(const Grid& grid, const std::vector<SpringRun>& rest) const {
    std::vector<bool> has_other(static_cast<std::size_t>(grid.points()), false);
    for (const SpringRun& run : rest)
      for (Index e = 0; e < run.count; ++e) {
        const Index i = run.first + e - grid.first, j = run.second + e - grid.first;
        const bool holds_i = i >= 0 && i < grid.points(), holds_j = j >= 0 && j < grid.points();
        if (holds_i && holds_j && is_bend(grid, i, j)) continue;
        if (holds_i) has_other[i] = true;
        if (holds_j) has_other[j] = true;
      }
    return 4 * std::ranges::count(has_other, true) > grid.points();
  }

  // Whether two points of a grid, by their numbers in it, are second next neighbors in a row or column.
  static bool is_bend(const Grid& grid, Index i, Index j) {
    if (i > j) std::swap(i, j);
    return (j == i + 2 && i / grid.columns == j / grid.columns) || j == i + 2 * grid.columns;
  }

  // All points in their order, with those of refined grids in rows of twice the length; the new ones between others.
  void place_points() {
    std::uint32_t next_id = system_.next_point_id();
    for (Index i = 0; i < system_.point_count();) {
      const int in = grid_of_[i];
      if (in < 0) {
        append(system_.points()[i], state_.position[i], state_.velocity[i]);
        ++i;
        continue;
      }
      Fine& fine = fine_[in];
      const Grid& grid = *fine.grid;
      fine.first = static_cast<Index>(points_.size());
      for (Index r = 0; r < fine.rows; ++r)
        for (Index c = 0; c < fine.columns; ++c) append_between(grid, r, c, next_id);
      i += grid.points();
    }
  }

  void append(const Point& point, const Vec3& position, const Vec3& velocity) {
    points_.push_back(point);
    position_.push_back(position);
    velocity_.push_back(velocity);
  }

  void append_between(const Grid& grid, Index r, Index c, std::uint32_t& next_id) {
    // the one, two or four points around it
    const Index top = r / 2, left = c / 2, bottom = (r + 1) / 2, right = (c + 1) / 2;
    const std::array<Index, 4> around{grid.first + top * grid.columns + left, grid.first + top * grid.columns + right,
                                      grid.first + bottom * grid.columns + left, grid.first + bottom * grid.columns + right};
    Vec3 position(0.0), velocity(0.0);
    Point point = system_.points()[around[0]];
    const bool is_old = r % 2 == 0 && c % 2 == 0;
    if (is_old) {
      point.mass = 0.0;
      append(point, state_.position[around[0]], state_.velocity[around[0]]);
      return;
    }
    for (const Index i : around) {
      position += 0.25 * state_.position[i];
      velocity += 0.25 * state_.velocity[i];
      point.nailed = point.nailed && system_.points()[i].nailed;
      point.radius = std::min(point.radius, system_.points()[i].radius);
    }
    point.id = PointId{next_id++};
    point.mass = 0.0;
    append(point, position, velocity);
  }

  // The part of a point's mass that belongs to the sheet or rope is spread over the quarters of cells, or halves of segments, around it;
  // the rest stays.
  void add_masses(const Fine& fine) {
    const Grid& grid = *fine.grid;
    const bool is_rope = grid.rows == 1;
    const auto cells_of = [&](Index r, Index c) {
      const int beside = (c > 0 ? 1 : 0) + (c + 1 < grid.columns ? 1 : 0);
      return is_rope ? beside : beside * ((r > 0 ? 1 : 0) + (r + 1 < grid.rows ? 1 : 0));
    };
    const int most = is_rope ? 2 : 4;
    std::vector<double> full;  // mass of a point with all cells
    for (Index i = 0; i < grid.points(); ++i) full.push_back(mass_at(grid, i) * most / cells_of(i / grid.columns, i % grid.columns));
    std::vector<double> sorted = full;
    std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2));
    const double typical = sorted[sorted.size() / 2];

    for (Index r = 0; r < grid.rows; ++r)
      for (Index c = 0; c < grid.columns; ++c) {
        const double mass = mass_at(grid, r * grid.columns + c);
        const int cells = cells_of(r, c);
        const double of_sheet = std::min(mass, typical * cells / most), each = of_sheet / cells;
        add_mass(fine, 2 * r, 2 * c, mass - of_sheet);
        for (const Index dc : {-1, 1}) {
          if (c + dc < 0 || c + dc >= grid.columns) continue;
          if (is_rope) {
            for (const Index end : {0, dc}) add_mass(fine, 0, 2 * c + end, 0.5 * each);
            continue;
          }
          for (const Index dr : {-1, 1}) {
            if (r + dr < 0 || r + dr >= grid.rows) continue;
            for (const Index down : {0, dr})
              for (const Index beside : {0, dc}) add_mass(fine, 2 * r + down, 2 * c + beside, 0.25 * each);
          }
        }
      }
  }
  double mass_at(const Grid& grid, Index i) const { return system_.points()[grid.first + i].mass; }
  void add_mass(const Fine& fine, Index r, Index c, double mass) { points_[static_cast<std::size_t>(fine.at(r, c))].mass += mass; }
  const Spring& spring(Index s) const { return original_springs_[s]; }

  // The spring of a direction at a cell, or null.
  const Spring* at(const Grid& grid, Grid::Direction direction, Index r, Index c) const {
    if (r < 0 || c < 0 || r >= grid.rows || c >= grid.columns) return nullptr;
    const Index s = grid.spring[direction][static_cast<std::size_t>(r) * grid.pitch() + c];
    return s == no_index ? nullptr : &spring(s);
  }

  // `before` and `after`: the springs beside it, null where the sheet ends; `beyond_*`: whether these have one on their other side.
  static Fractions split(const Spring& one, const Spring* before, const Spring* after, bool has_two_before, bool has_two_after) {
    if (before != nullptr && after != nullptr) return {1.0, 0.5};
    const Spring* beside = before != nullptr ? before : after;
    if (beside == nullptr) return {2.0, 0.0};
    const bool is_inner = before != nullptr ? has_two_before : has_two_after;
    const double sheet = std::min(1.0, one.stiffness > 0.0 ? beside->stiffness * (is_inner ? 0.5 : 1.0) / one.stiffness : 1.0);
    return {sheet + 2.0 * (1.0 - sheet), sheet};
  }

  // Springs along rows (dc = 1) or columns (dr = 1) that join a point with the next one or, as bend springs do, the one after `reach`:
  // from every point of a refined line, as strong as the original spring find(row, column) there.
  template <class Find>
  void add_lines(const Fine& fine, Index reach, Index dr, Index dc, const Find& find) {
    const Grid& grid = *fine.grid;
    const Index length = dc == 1 ? grid.columns : grid.rows, lines_beside = dc == 1 ? grid.rows : grid.columns;
    if (length <= reach) return;
    std::map<std::pair<Index, Index>, Strength> lines;  // by the refined position of the first end
    for (Index across = 0; across < lines_beside; ++across)
      for (Index along = 0; along + reach < 2 * length - 1; ++along) {
        const Index start = std::clamp((along + 1 - reach) / 2, 0, length - 1 - reach);
        const auto beside = [&](Index by) { return find(dc == 1 ? across + by : start, dc == 1 ? start : across + by); };
        const Spring *one = beside(0), *before = beside(-1), *after = beside(1);
        if (one == nullptr) continue;
        const Fractions fractions = split(*one, before, after, beside(-2) != nullptr, beside(2) != nullptr);
        const Index fr = dc == 1 ? 2 * across : along, fc = dc == 1 ? along : 2 * across;
        lines[{fr, fc}].add(*one, fractions.line);
        if (before != nullptr) lines[{fr - dc, fc - dr}].add(*one, fractions.side);
        if (after != nullptr) lines[{fr + dc, fc + dr}].add(*one, fractions.side);
      }
    for (const auto& [place, strength] : lines)
      append(fine.at(place.first, place.second), fine.at(place.first + reach * dr, place.second + reach * dc), strength, 0.5);
  }

  void add_diagonals(const Fine& fine) {
    const Grid& grid = *fine.grid;
    for (Index r = 0; r + 1 < grid.rows; ++r)
      for (Index c = 0; c < grid.columns; ++c)
        for (const Grid::Direction direction : {Grid::Diagonal, Grid::Anti}) {
          const Spring* one = at(grid, direction, r, c);
          if (one == nullptr) continue;
          // Anti joins (r, c + 1) and (r + 1, c) of the cell that owns it
          Strength strength;
          strength.add(*one, 1.0);
          for (const Index down : {0, 1})
            for (const Index beside : {0, 1}) {
              const Index fr = 2 * r + down, fc = 2 * c + beside;
              if (direction == Grid::Diagonal)
                append(fine.at(fr, fc), fine.at(fr + 1, fc + 1), strength, 0.5);
              else
                append(fine.at(fr, fc + 1), fine.at(fr + 1, fc), strength, 0.5);
            }
        }
  }

  // Bend springs of a line, by the grid and the place of their first end.
  void add_bends() {
    std::vector<std::array<std::map<std::pair<Index, Index>, const Spring*>, 2>> bends(fine_.size());
    for (Index s = 0; s < system_.spring_count(); ++s) {
      if (is_in_grid_[s]) continue;
      Index i = system_.index_of(spring(s).first), j = system_.index_of(spring(s).second);
      if (i > j) std::swap(i, j);
      const int in = grid_of_[i];
      if (in < 0 || in != grid_of_[j]) continue;
      const Grid& grid = *fine_[in].grid;
      i -= grid.first, j -= grid.first;
      if (!is_bend(grid, i, j)) continue;
      bends[in][j == i + 2 ? 0 : 1][{i / grid.columns, i % grid.columns}] = &spring(s);
      is_in_grid_[s] = true;
    }
    for (std::size_t in = 0; in < fine_.size(); ++in)
      for (const std::size_t down : {0, 1})
        if (const auto& found = bends[in][down]; !found.empty())
          add_lines(fine_[in], 2, down == 1 ? 1 : 0, down == 1 ? 0 : 1, [&](Index r, Index c) {
            const auto bend = found.find({r, c});
            return bend == found.end() ? nullptr : bend->second;
          });
  }

  void add_other_springs() {
    for (Index s = 0; s < system_.spring_count(); ++s) {
      if (is_in_grid_[s]) continue;
      Spring copy = spring(s);
      copy.id = SpringId{next_spring_id_++};
      springs_.push_back(copy);
    }
  }

  void append(Index i, Index j, const Strength& strength, double length_ratio) {
    springs_.push_back({.id = SpringId{next_spring_id_++},
                        .first = points_[i].id,
                        .second = points_[j].id,
                        .family = strength.family,
                        .stiffness = strength.k,
                        .damping = strength.d,
                        .rest_length = strength.weight > 0.0 ? length_ratio * strength.length / strength.weight : 0.0,
                        .break_strain = strength.break_strain});
  }

  // A face of a refined cell becomes four, which are flat between each other: those of the corners, and the middle.
  std::vector<Face> finer_face(const Face& face) const {
    const int in = grid_of_[system_.index_of(face.points[0])];
    if (in < 0) return {face};
    const Fine& fine = fine_[in];
    std::array<std::array<Index, 2>, 3> cell;  // row, column
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Index i = system_.index_of(face.points[corner]), at = i - fine.grid->first;
      if (grid_of_[i] != in) return {face};
      cell[corner] = {at / fine.grid->columns, at % fine.grid->columns};
      for (std::size_t other = 0; other < corner; ++other)
        for (const int c : {0, 1})
          if (std::abs(cell[corner][c] - cell[other][c]) > 1) return {face};
    }
    const auto id = [&](int a, int b) { return points_[fine.at(cell[a][0] + cell[b][0], cell[a][1] + cell[b][1])].id; };
    const auto& [t0, t1, t2] = face.rest_angle;
    return {{{id(0, 0), id(0, 1), id(0, 2)}, {0.0, t1, t2}},
            {{id(0, 1), id(1, 1), id(1, 2)}, {t0, 0.0, t2}},
            {{id(0, 2), id(1, 2), id(2, 2)}, {t0, t1, 0.0}},
            {{id(0, 1), id(1, 2), id(0, 2)}}};
  }

  // A quad becomes four quads.
  FaceList finer_faces() const {
    FaceList faces;
    for (std::size_t f = 0; f < system_.faces.size(); ++f) {
      std::vector<Face> own = finer_face(system_.faces[f]), other;
      if (system_.faces.is_quad(f)) other = finer_face(system_.faces[f + 1]);
      if (own.size() == 4 && other.size() == 4) {
        const auto& [i, j, k] = own[3].points;
        own = {own[0], Face{{k, i, j}}, own[1], other[1], own[2], other[0], other[3], other[2]};
        ++f;
      }
      for (const Face& each : own) faces.push_back(each);
    }
    return faces;
  }

  FinerNetwork finish() {
    FinerNetwork result;
    for (const Fine& fine : fine_) ++(fine.grid->rows == 1 ? result.ropes : result.sheets);
    // with everything that is not a list of points, springs or faces
    result.system = system_;
    result.system.faces = finer_faces();
    result.system.set_springs({});
    result.system.set_points(std::move(points_));
    result.system.set_springs(springs_);
    result.state = state_;
    result.state.position = std::move(position_);
    result.state.velocity = std::move(velocity_);
    result.state.memory = {};
    result.state.torn = 0;
    initialize_supply(result.system, result.state);
    return result;
  }

  const System& system_;
  const State& state_;
  const std::vector<Spring> original_springs_ = system_.springs();
  std::vector<Grid> grids_;
  std::vector<int> grid_of_;      // of each point: its index in fine_, or -1
  std::vector<bool> is_in_grid_;  // of each spring
  std::vector<Fine> fine_;
  std::vector<Point> points_;
  std::vector<Vec3> position_, velocity_;
  std::vector<Spring> springs_;
  std::uint32_t next_spring_id_ = 0;
};

}  // namespace

std::optional<FinerNetwork> refine_network(const System& system, const State& state, Index max_points) {
  return NetworkRefinement(system, state).run(max_points);
}

}  // namespace hooke
