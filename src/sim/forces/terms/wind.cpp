// Air that moves past faces and quads: f = A (a |u.n| (u.n) n + b |u_t| u_t), u the wind relative to the mean velocity of the corners, n
// the normal, u_t the tangential part of u; an equal part acts on each corner. In scenes without faces: A = pi r^2 and n along u, for each
// point. Gusts: the wind speed varies by smooth noise from a seed, the same in every run.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <vector>

#include "sim/forces/constants.h"
#include "sim/forces/force_tangent.h"
#include "sim/forces/terms/rows.h"
#include "sim/forces/terms/wind_kernel.h"
#include "sim/plan/plan.h"

namespace hooke {
namespace {

constexpr ForceParameter numbers[] = {
    {"x", "Wind x", "m/s", -50.0, 50.0, 3.0},
    {"y", "Wind y", "m/s", -50.0, 50.0, 0.0},
    {"z", "Wind z", "m/s", -50.0, 50.0, 1.0},
    {"normal", "Normal drag", "kg/m^3", 0.0, 5.0, 0.6},
    {"tangential", "Tangential drag", "kg/m^3", 0.0, 1.0, 0.01},
    {"gusts", "Gusts", "of the speed", 0.0, 1.0, 0.3},
    {"gust_time", "Gust duration", "s", 0.05, 10.0, 0.7},
    {"seed", "Seed", "", 0.0, 1e6, 1.0, true},
};

// In [-1, 1], a function of its arguments: the finalizer of SplitMix64 (Steele, Lea, Flood 2014).
double random_at(std::int64_t place, double seed) {
  auto z = static_cast<std::uint64_t>(place) * 0x9e3779b97f4a7c15ull + static_cast<std::uint64_t>(seed) * 0xd1b54a32d192ed03ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-52 - 1.0;
}

// Interpolates between random values at integers, with a continuous slope.
double smooth_noise(double t, double seed) {
  const double whole = std::floor(t), part = t - whole;
  const auto place = static_cast<std::int64_t>(whole);
  const double blend = part * part * (3.0 - 2.0 * part);
  return (1.0 - blend) * random_at(place, seed) + blend * random_at(place + 1, seed);
}

}  // namespace

Vec3 wind_at(const Plan& plan, const ForceValues& values, double time) {
  const double gust = 1.0 + values[5] * smooth_noise(time / values[6], values[7]);
  return gust * Vec3(values[0], values[1], plan.dimensions == 3 ? values[2] : 0.0);
}

namespace {

std::span<const Index> corners_of(const Panel<Index>& panel) { return {panel.data(), panel[3] == no_index ? 3u : 4u}; }

// Of a quad, the cross product of its diagonals: the sum of those of both halves, whatever the diagonal.
Vec3 twice_area_of(const Plan& plan, const Panel<Index>& panel, const double* x) {
  const Vec3 a = vector_at(plan, x, panel[0]), b = vector_at(plan, x, panel[1]), c = vector_at(plan, x, panel[2]);
  return panel[3] == no_index ? glm::cross(b - a, c - a) : glm::cross(c - a, vector_at(plan, x, panel[3]) - b);
}

Vec3 mean_velocity(const Plan& plan, const Panel<Index>& panel, const double* v) {
  const Vec3 sum = vector_at(plan, v, panel[0]) + vector_at(plan, v, panel[1]) + vector_at(plan, v, panel[2]);
  return panel[3] == no_index ? 1.0 / 3.0 * sum : 0.25 * (sum + vector_at(plan, v, panel[3]));
}

// The force on each of the n corners. With N of twice the area, q = u.N / N.N and u_t = u - q N:
//   A a |u.n| (u.n) n = a/2 |u.N| q N,  A b |u_t| u_t = b/2 sqrt(N.N u_t.u_t) u_t
// with a division and a square root.
Vec3 force_on_corner(const Plan& plan, const Panel<Index>& panel, const Wind& wind, const double* x, const double* v) {
  const Vec3 twice_area = twice_area_of(plan, panel, x);
  const double square = glm::dot(twice_area, twice_area);
  if (square < min_square_of_area) return Vec3(0.0);
  const Vec3 past = wind.velocity - mean_velocity(plan, panel, v);
  const double flux = glm::dot(past, twice_area), across = flux / square, twice_corners = panel[3] == no_index ? 6.0 : 8.0;
  const Vec3 along = past - across * twice_area;
  const double of_normal = wind.normal / twice_corners * std::abs(flux) * across,
               of_tangential = wind.tangential / twice_corners * std::sqrt(square * glm::dot(along, along));
  return of_normal * twice_area + of_tangential * along;
}

constexpr double pi = 3.14159265358979323846;

// For each point, in scenes without faces: a pi r^2.
double point_coefficient(const Plan& plan, const ForceValues& values, Index i) { return values[3] * pi * plan.radius[i] * plan.radius[i]; }

// In a fixed order: use_row(wind, row) for the rows of panels, use_panel(panel, force on each corner) for all others, or, in scenes without
// faces, use_point(point, force).
template <class UseRow, class UsePanel, class UsePoint>
void for_each_force(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v, const UseRow& use_row,
                    const UsePanel& use_panel, const UsePoint& use_point) {
  const Wind wind{wind_at(plan, values, time), values[3], values[4]};
  const std::vector<Panel<Index>>& panels = plan.force_data.panels;
  const auto use_panels = [&](Index first, Index end) {
    for (Index p = first; p < end; ++p) use_panel(panels[p], force_on_corner(plan, panels[p], wind, x, v));
  };
  Index next = 0;
  for (const PanelRow& row : plan.force_data.panel_rows) {
    use_panels(next, row.first);
    use_row(wind, row);
    next = row.first + row.cells;
  }
  use_panels(next, static_cast<Index>(panels.size()));
  if (!panels.empty()) return;

  for (Index i = 0; i < plan.points; ++i) {
    const Vec3 past = wind.velocity - vector_at(plan, v, i);
    use_point(i, point_coefficient(plan, values, i) * glm::length(past) * past);
  }
}

void add(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v, double* f) {
  for_each_force(
      plan, values, time, x, v, [&](const Wind& wind, const PanelRow& row) { compute_wind_on_cells(plan, wind, row, x, v, f, nullptr); },
      [&](const Panel<Index>& panel, const Vec3& force) {
        for (const Index corner : corners_of(panel)) add_vector(plan, f, corner, force);
      },
      [&](Index i, const Vec3& force) { add_vector(plan, f, i, force); });
}

// Of the forces on the held point, which the hand moves.
double power_on_held(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v) {
  const Wind wind{wind_at(plan, values, time), values[3], values[4]};
  Vec3 sum{0.0};
  for (const Panel<Index>& panel : plan.force_data.panels)
    if (std::ranges::find(panel, *plan.hand.held) != panel.end()) sum += force_on_corner(plan, panel, wind, x, v);
  return glm::dot(sum, vector_at(plan, v, *plan.hand.held));
}

// Nailed points do not move. Adds the forces to f, too, unless it is null.
double add_with_power(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v, double* f) {
  double sum = 0.0;
  CellPowers of_cells;
  for_each_force(
      plan, values, time, x, v, [&](const Wind& wind, const PanelRow& row) { compute_wind_on_cells(plan, wind, row, x, v, f, &of_cells); },
      [&](const Panel<Index>& panel, const Vec3& force) {
        for (const Index corner : corners_of(panel)) {
          sum += glm::dot(force, vector_at(plan, v, corner));
          if (f != nullptr) add_vector(plan, f, corner, force);
        }
      },
      [&](Index i, const Vec3& force) {
        if (plan.hand.held != i) sum += glm::dot(force, vector_at(plan, v, i));
        if (f != nullptr) add_vector(plan, f, i, force);
      });
  return sum + of_cells.sum() - (plan.hand.held ? power_on_held(plan, values, time, x, v) : 0.0);
}

double power(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v) {
  return add_with_power(plan, values, time, x, v, nullptr);
}

// Near the rest lengths, in the wind at its full speed u relative to the points, in [1/s^2] and [1/s]. A face with edges of length l has
// the area l^2 / 2. A displacement of a corner changes its force by up to (a + b) u^2 / 6 times the opposite edge; the sum over the three
// corners contains the perimeter, 3.4 l. A velocity changes the forces by up to 2 (a + b) u times a third of the area.
struct FaceEstimate {
  double stiffness = 0.0, rate = 0.0;
};
FaceEstimate estimate_faces(const System& system, double coefficient, double speed) {
  std::vector<double> length(system.points().size(), std::numeric_limits<double>::infinity());
  for (const Spring& spring : system.springs())
    for (const PointId end : {spring.first, spring.second})
      if (spring.rest_length > 0.0) length[system.index_of(end)] = std::min(length[system.index_of(end)], spring.rest_length);

  std::vector<FaceEstimate> row(system.points().size());
  for (const Face& face : system.faces) {
    double edge = 0.0;
    for (const PointId corner : face.points)
      if (const double l = length[system.index_of(corner)]; std::isfinite(l)) edge = std::max(edge, l);
    for (const PointId corner : face.points) {
      const Index i = system.index_of(corner);
      if (system.points()[i].nailed) continue;
      row[i].stiffness += coefficient * speed * speed * perimeter_of_face * edge / (6.0 * system.points()[i].mass);
      row[i].rate += coefficient * speed * edge * edge / (3.0 * system.points()[i].mass);
    }
  }
  FaceEstimate max;
  for (const FaceEstimate& each : row) max = {std::max(max.stiffness, each.stiffness), std::max(max.rate, each.rate)};
  return max;
}

// Quadratic in the speed, and proportional to areas that grow as faces stretch: no bound exists.
ForceBound bound(const System& system, const Plan&, const ForceValues& values, double point_speed) {
  ForceBound bound{.stiffness = ForceBound::none,
                   .rate = ForceBound::none,
                   .speed = (1.0 + values[5]) * glm::length(Vec3(values[0], values[1], values[2]))};
  const double relative_speed = bound.speed + point_speed;
  if (system.faces.empty()) {
    for (const Point& point : system.points())
      if (!point.nailed)
        bound.estimated_rate =
            std::max(bound.estimated_rate, 2.0 * values[3] * pi * point.radius * point.radius * relative_speed / point.mass);
    return bound;
  }
  const FaceEstimate faces = estimate_faces(system, values[3] + values[4], relative_speed);
  bound.estimated_stiffness = bound.omitted_stiffness = faces.stiffness;
  bound.estimated_rate = faces.rate;
  return bound;
}

// A panel couples its n corners: -df_i/dv_j = D / n^2. Half the sum of a row on the diagonal, D / 2n, is midway between the eigenvalues 0
// and D / n of the whole, so that iterations converge for any step.
void add_tangent(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v, ForceTangent& tangent) {
  const Vec3 wind = wind_at(plan, values, time);
  for (const Panel<Index>& panel : plan.force_data.panels) {
    const Vec3 twice_area = twice_area_of(plan, panel, x), past = wind - mean_velocity(plan, panel, v);
    const double length = glm::length(twice_area);
    if (length == 0.0) continue;
    const Vec3 normal = twice_area / length;
    const double across = glm::dot(past, normal);
    const auto corners = corners_of(panel);
    const double fraction = 0.5 * length / static_cast<double>(corners.size()), axial = fraction * values[3] * std::abs(across),
                 transverse = fraction * values[4] * glm::length(past - across * normal);
    for (const Index corner : corners) tangent.add_damping(corner, normal, axial, transverse);
  }
  if (!plan.force_data.panels.empty()) return;

  for (Index i = 0; i < plan.points; ++i) {
    const Vec3 past = wind - vector_at(plan, v, i);
    const double speed = glm::length(past), coefficient = point_coefficient(plan, values, i) * speed;
    tangent.add_damping(i, speed > 0.0 ? past / speed : Vec3(1.0, 0.0, 0.0), 2.0 * coefficient, coefficient);
  }
}

ForceCost cost(const Plan& plan, const ForceValues&) {
  if (plan.force_data.faces == 0) return {.evaluation = 1.5, .energy = 11.0};
  return {.evaluation = 5.0, .energy = 14.0, .of_faces = true};
}

void prepare(const System& system, Plan& plan) {
  plan.force_data.panels.clear();
  for (std::size_t f = 0; f < system.faces.size(); ++f) {
    const bool is_quad = system.faces.is_quad(f);
    const auto [a, b, c] = system.faces[f].points;
    const Panel<PointId> corners = is_quad ? system.faces.quad(f) : Panel<PointId>{a, b, c};
    Panel<Index>& panel = plan.force_data.panels.emplace_back();
    for (std::size_t i = 0; i < corners.size(); ++i) panel[i] = i < 3 || is_quad ? system.index_of(corners[i]) : no_index;
    if (is_quad) ++f;
  }
  plan.force_data.panel_rows = find_panel_rows(plan.force_data.panels);
}

}  // namespace

constinit const ForceTerm wind_force{
    .id = "wind",
    .rank = 0,
    .label = "Wind",
    .description = "Moving air that exerts normal and tangential forces on the faces, with gusts.",
    .numbers = numbers,
    .depends_on_velocity = true,
    .add = add,
    .bound = bound,
    .add_tangent = add_tangent,
    .power = power,
    .add_with_power = add_with_power,
    .cost = cost,
    .prepare = prepare,
};

}  // namespace hooke
