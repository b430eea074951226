#include "device/packed_scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/overloaded.h"
#include "sim/contact/obstacle.h"
#include "sim/forces/dashpots/dashpot.h"
#include "sim/forces/kick.h"
#include "sim/forces/terms/wind_kernel.h"

namespace hooke {
namespace {

void append(std::vector<double>& numbers, const Vec3& vector, double w = 0.0) {
  numbers.insert(numbers.end(), {vector.x, vector.y, vector.z, w});
}

// Lists the items that `for_each(use)` names, by use(point, number..), twice in the same order; `width` numbers make an item.
template <class ForEach>
PointLists list_by_points(Index points, std::size_t width, const ForEach& for_each) {
  PointLists lists;
  lists.first.assign(points + 1, 0);
  for_each([&](Index point, auto...) { ++lists.first[point + 1]; });
  std::partial_sum(lists.first.begin(), lists.first.end(), lists.first.begin());
  lists.items.resize(width * static_cast<std::size_t>(lists.first.back()));
  std::vector<Index> next = lists.first;
  for_each([&](Index point, auto... item) {
    std::size_t at = width * static_cast<std::size_t>(next[point]++);
    ((lists.items[at++] = item), ...);
  });
  return lists;
}

}  // namespace

SpringGraph graph_of(const Plan& plan) {
  SpringGraph graph;
  for_each_spring(plan, [&](Index i, Index j, Index) { graph.ends.insert(graph.ends.end(), {i, j}); });
  graph.neighbors = list_by_points(plan.points, 2, [&](const auto& use) {
    for_each_spring(plan, [&](Index i, Index j, Index s) {
      use(i, j, s);
      use(j, i, s);
    });
  });
  return graph;
}

PointLists panels_of_points(const Plan& plan) {
  const std::vector<Panel<Index>>& panels = plan.force_data.panels;
  return list_by_points(plan.points, 1, [&](const auto& use) {
    for (std::size_t p = 0; p < panels.size(); ++p)
      for (const Index corner : panels[p])
        if (corner != no_index) use(corner, static_cast<Index>(p));
  });
}

bool is_grid(const Plan& plan) {
  const PlannedSprings& spring = plan.spring;
  return spring.grids.size() == 1 && spring.loose_runs.empty() && spring.grids[0].points() == plan.points && spring.laws.empty() &&
         spring.break_length.empty();
}

Index stored_rows(const Grid& grid) {
  const auto differ = [](const Grid::Values& values) { return values.row_step != 0; };
  const bool any = std::ranges::any_of(grid.stiffness, differ) || std::ranges::any_of(grid.rest_length, differ) ||
                   std::ranges::any_of(grid.damping, differ);
  return any ? grid.rows : 1;
}

std::vector<double> state_numbers(const Plan& plan, const Motion& motion) {
  const auto n = static_cast<std::size_t>(plan.points);
  std::vector<double> numbers(12 * n);
  for (std::size_t i = 0; i < n; ++i) numbers[4 * i + 3] = plan.inverse_mass[i];
  for (std::size_t c = 0; c < static_cast<std::size_t>(plan.dimensions); ++c)
    for (std::size_t i = 0; i < n; ++i) {
      numbers[4 * i + c] = motion.x[c * n + i];
      numbers[4 * (n + i) + c] = motion.v[c * n + i];
    }
  return numbers;
}

void read_state(const std::vector<double>& numbers, const Plan& plan, Motion& motion) {
  const auto n = static_cast<std::size_t>(plan.points);
  for (std::size_t c = 0; c < static_cast<std::size_t>(plan.dimensions); ++c)
    for (std::size_t i = 0; i < n; ++i) {
      if (plan.inverse_mass[i] == 0.0 && plan.hand.held != static_cast<Index>(i)) continue;  // it keeps all its digits
      motion.x[c * n + i] = numbers[4 * i + c];
      motion.v[c * n + i] = numbers[4 * (n + i) + c];
    }
}

// Direction by direction, and cell by cell. The last row has springs to the right only; the grid does not store the others.
std::vector<double> grid_numbers(const Plan& plan, const Grid& grid) {
  std::vector<double> numbers;
  const Index rows = stored_rows(grid);
  for (std::size_t d = 0; d < Grid::directions; ++d)
    for (Index r = 0; r < rows; ++r)
      for (Index c = 0; c < grid.columns; ++c) {
        const bool is_stored = d == Grid::Right || rows == 1 || r + 1 < rows;
        const double damping = is_stored && plan.has_dashpots() ? grid.damping[d].row(r)[c] : 0.0;
        append(numbers, is_stored ? Vec3(grid.stiffness[d].row(r)[c], grid.rest_length[d].row(r)[c], damping) : Vec3(0.0));
      }
  return numbers;
}

std::vector<double> spring_numbers(const Plan& plan) {
  if (is_grid(plan)) return grid_numbers(plan, plan.spring.grids[0]);
  const PlannedSprings& spring = plan.spring;
  std::vector<double> numbers(4 * static_cast<std::size_t>(plan.springs), 0.0);
  for (std::size_t s = 0, at = 0; s < static_cast<std::size_t>(plan.springs); ++s, at += 4) {
    numbers[at] = spring.stiffness[s];
    numbers[at + 1] = spring.rest_length[s];
    if (plan.has_dashpots()) numbers[at + 2] = spring.damping[s];
    const Index law = spring.laws.empty() ? no_index : spring.laws.of_packed[s];
    if (law == no_index) continue;
    const LawSpring& of = spring.laws.springs[law];
    numbers[at] = of.stiffness;
    numbers[at + 2] = of.stiffness > 0.0 ? of.damping : 0.0;
    numbers[at + 3] = of.law.force == SpringForce::Cable ? 1.0 : 0.0;
  }
  return numbers;
}

std::vector<double> limit_numbers(const Plan& plan) {
  std::vector<double> numbers;
  for (const double length : plan.spring.break_length) numbers.insert(numbers.end(), {length, 0.0});
  return numbers;
}

std::vector<double> frame_numbers(const Plan& plan, const FrameSteps& steps) {
  std::vector<double> numbers;
  const Vec3 acceleration = plan.dimensions == 3 ? plan.acceleration : Vec3(plan.acceleration.x, plan.acceleration.y, 0.0);
  append(numbers, acceleration);
  Vec3 weights(0.0);
  if (plan.hand.pull)
    for (int p = 0; p < plan.hand.pull->count; ++p) weights[p] = plan.hand.pull->parts[p].weight;
  append(numbers, weights, plan.hand.pull ? plan.hand.pull->stiffness : 0.0);
  append(numbers, plan.forces.empty() ? Vec3(0.0) : Vec3(plan.forces[0].values[3], plan.forces[0].values[4], 0.0));
  append(numbers, {steps.h, steps.method.is_symplectic() ? steps.method.velocity_lag : 0.0, plan.spectrum.dashpot_rate}, plan.drag);
  const Kick<double> whole = kick_over(plan.drag, steps.h), half = kick_over(plan.drag, 0.5 * steps.h);
  append(numbers, plan.hand.pull ? plan.hand.pull->velocity : Vec3(0.0));
  append(numbers, plan.hand.held_mass * plan.gravity, plan.hand.held.value_or(no_index));
  for (const auto& [kick, drift, duration] :
       {std::tuple{whole, steps.h, steps.h}, std::tuple{half, steps.h, 0.5 * steps.h}, std::tuple{half, 0.0, 0.5 * steps.h}}) {
    append(numbers, {kick.decay, kick.weight, drift}, half.decay);
    append(numbers, {half.weight, duration, 0.0});
  }
  return numbers;
}

std::vector<double> moment_numbers(const Plan& plan, const FrameSteps& steps, double start) {
  std::vector<double> numbers;
  for (int k = 0; k <= steps.count; ++k) {
    const double time = start + k * steps.h;
    Vec3 target = plan.hand.pull ? plan.hand.pull->target_at(time) : Vec3(0.0);
    if (plan.dimensions == 2) target.z = 0.0;
    append(numbers, target);
    append(numbers, plan.forces.empty() ? Vec3(0.0) : wind_at(plan, plan.forces[0].values, time));
  }
  return numbers;
}

std::vector<double> collider_numbers(const Plan& plan, const FrameSteps& steps, double start) {
  std::vector<double> numbers;
  for (const Collider& collider : plan.colliders) {
    std::visit(Overloaded{[&](const Plane& plane) {
                            append(numbers, plane.point, 0.0);
                            append(numbers, plane.normal);
                          },
                          [&](const Sphere& sphere) {
                            append(numbers, sphere.center, 1.0);
                            append(numbers, Vec3(0.0), sphere.radius);
                          },
                          [&](const Box& box) {
                            append(numbers, box.min, 2.0);
                            append(numbers, box.max);
                          }},
               collider.shape);
    append(numbers, collider.path.spin, collider.restitution);
    append(numbers, collider.path.belt, collider.friction);
  }
  std::vector<Obstacle> obstacles;
  for (int k = 0; k < steps.count; ++k)
    for (const Obstacle& obstacle : find_obstacles(plan, start + k * steps.h, steps.h, obstacles))
      for (const Vec3& vector : {obstacle.offset, obstacle.velocity, obstacle.acceleration, obstacle.velocity_correction})
        append(numbers, vector);
  return numbers;
}

SweepLevels sweep_levels(const Plan& plan, double duration) {
  std::vector<double> loss;  // [kg], impulse per relative speed
  plan_dashpot_decay(plan, duration, loss);
  const auto law_of = [&](Index s) { return plan.spring.laws.empty() ? no_index : plan.spring.laws.of_packed[s]; };

  // (first point, second point, spring) in the order of the processor: of a row every other spring first; those with a law last
  std::vector<std::array<Index, 3>> order;
  for (const SpringRun& run : plan.spring.runs) {
    const Index step = run.second == run.first + 1 ? 2 : 1;
    for (Index start = 0; start < step; ++start)
      for (Index e = start; e < run.count; e += step)
        if (loss[run.begin + e] > 0.0 && law_of(run.begin + e) == no_index) order.push_back({run.first + e, run.second + e, run.begin + e});
  }
  for_each_spring(plan, [&](Index i, Index j, Index s) {
    const double inverse_mass = plan.inverse_mass[i] + plan.inverse_mass[j];
    if (law_of(s) == no_index || inverse_mass == 0.0) return;
    loss[s] = -portable::expm1(-plan.spring.laws.springs[law_of(s)].damping * duration * inverse_mass) / inverse_mass;
    order.push_back({i, j, s});
  });

  std::vector<Index> levels, next(plan.points, 0);
  for (const auto& [i, j, s] : order) levels.push_back(next[i] = next[j] = std::max(next[i], next[j]) + 1);
  const Index count = levels.empty() ? 0 : std::ranges::max(levels);
  const PointLists lists = list_by_points(count, 3, [&](const auto& use) {
    for (std::size_t n = 0; n < order.size(); ++n) use(levels[n] - 1, order[n][0], order[n][1], order[n][2]);
  });
  SweepLevels sweeps{.begin = lists.first};
  for (std::size_t at = 0; at < lists.items.size(); at += 3)
    append(sweeps.numbers, {lists.items[at], lists.items[at + 1], loss[lists.items[at + 2]]}, lists.items[at + 2]);
  return sweeps;
}

}  // namespace hooke
