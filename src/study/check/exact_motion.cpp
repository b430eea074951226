#include "study/check/exact_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "base/number_text.h"
#include "sim/contact/contact.h"
#include "sim/control/automatic.h"
#include "sim/forces/energy/energy.h"
#include "sim/forces/motion.h"
#include "sim/methods/integrator.h"
#include "sim/model/bounding_box.h"
#include "sim/statics/linear_motion.h"
#include "study/forecast.h"

namespace hooke {
namespace {

// Anything that makes the motion nonlinear, or is not part of the formulas.
bool has_only_springs_weight_and_drag(const System& system, const State& state) {
  const bool has_limits = system.strain_limit > 0.0 || system.springs().have_laws() || system.any_spring_breaks();
  return !has_limits && !system.grab && !system.scripted_hand && !state.hand.collider && std::ranges::none_of(system.forces, &Force::on);
}

Companion companion_of(std::string name, LinearMotion motion) {
  return {.name = std::move(name), .exact = [linear = std::make_shared<LinearMotion>(std::move(motion))](State& state, double seconds) {
            linear->advance(state, seconds);
          }};
}

// The line on which all points, velocities and accelerations are; none if there is none.
std::optional<Vec3> common_line(const System& system, const State& state) {
  Vec3 line(0.0);
  for (const Vec3& x : state.position)
    if (const Vec3 to = x - state.position[0]; glm::length(to) > glm::length(line)) line = to;
  if (!(glm::length(line) > 0.0)) return std::nullopt;
  const double size = glm::length(line);
  line /= size;
  constexpr double round_off = 1e-9;
  const auto is_along = [&](const Vec3& vector, double scale) {
    return glm::length(vector - glm::dot(vector, line) * line) <= round_off * scale;
  };
  for (const Vec3& x : state.position)
    if (!is_along(x - state.position[0], size)) return std::nullopt;
  for (const Vec3& v : state.velocity)
    if (!is_along(v, std::max(1e-6, glm::length(v)))) return std::nullopt;
  for (const Point& point : system.points())
    if (!is_along(point.load, glm::length(point.load))) return std::nullopt;
  if (!is_along(system.gravity, glm::length(system.gravity)) || !is_along(system.drag_rate() * system.wind, 1.0)) return std::nullopt;
  return line;
}

// Whether the springs rotate and stretch little on the way to the equilibrium, and beyond it.
bool is_small_vibration(const System& system, const State& state, const Forecast& forecast) {
  constexpr double small = 0.05;
  const double omega = forecast.slowest->omega;
  return std::ranges::all_of(system.springs(), [&](const Spring& spring) {
    const auto i = static_cast<std::size_t>(system.index_of(spring.first)), j = static_cast<std::size_t>(system.index_of(spring.second));
    const double length = glm::distance(forecast.rest[i], forecast.rest[j]);
    const Vec3 displacement = (state.position[j] - forecast.rest[j]) - (state.position[i] - forecast.rest[i]);
    const Vec3 velocity = state.velocity[j] - state.velocity[i];
    return glm::length(displacement) < small * length && glm::length(velocity) < small * length * omega;
  });
}

// ---- the elastic catenary

// A rope of equal parts between two nails, in the order of its points.
struct HangingRope {
  double length = 0.0, stiffness = 0.0, weight = 0.0;  // [m] unstretched, EA [N], per unstretched length [N/m]
};

std::optional<HangingRope> hanging_rope(const System& system) {
  const auto& points = system.points();
  const auto& springs = system.springs();
  constexpr std::size_t min_points = 8;
  if (points.size() < min_points || springs.size() + 1 != points.size() || !points.front().nailed || !points.back().nailed)
    return std::nullopt;
  constexpr double same = 1e-9;
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const Index i = system.index_of(springs[s].first), j = system.index_of(springs[s].second);
    const bool follows = std::min(i, j) == static_cast<Index>(s) && std::abs(i - j) == 1;
    if (!follows || std::abs(springs[s].stiffness - springs[0].stiffness) > same * springs[0].stiffness ||
        std::abs(springs[s].rest_length - springs[0].rest_length) > same * springs[0].rest_length)
      return std::nullopt;
  }
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    if (points[i].nailed || points[i].fixed_axes != 0 || points[i].load != Vec3(0.0) ||
        std::abs(points[i].mass - points[1].mass) > same * points[1].mass)
      return std::nullopt;
  const double l0 = springs[0].rest_length;
  if (!(l0 > 0.0) || !(springs[0].stiffness > 0.0) || !(glm::length(system.gravity) > 0.0)) return std::nullopt;
  return HangingRope{.length = l0 * static_cast<double>(springs.size()),
                     .stiffness = springs[0].stiffness * l0,
                     .weight = points[1].mass * glm::length(system.gravity) / l0};
}

// H. M. Irvine (1981), 1.3: horizontal tension H, vertical reaction V at the first end; [m] across and down from it at the unstretched
// length s.
std::pair<double, double> place_on(const HangingRope& rope, double h, double v, double s) {
  const double rest = v - rope.weight * s;
  const double across = h * s / rope.stiffness + h / rope.weight * (std::asinh(v / h) - std::asinh(rest / h));
  const double down =
      s / rope.stiffness * (v - 0.5 * rope.weight * s) + h / rope.weight * (std::hypot(1.0, v / h) - std::hypot(1.0, rest / h));
  return {across, down};
}

// The tensions with which the rope ends `across` and `down` from its start, by Newton's method; none if it does not converge.
std::optional<std::pair<double, double>> solve(const HangingRope& rope, double across, double down) {
  const double slack = (rope.length * rope.length - down * down) / (across * across) - 1.0;
  const double lambda = slack > 0.0 ? std::sqrt(3.0 * slack) : 0.2;
  double h = rope.weight * across / (2.0 * lambda), v = 0.5 * rope.weight * (rope.length - down / std::tanh(lambda));
  const auto residual = [&](double some_h, double some_v) {
    const auto [x, z] = place_on(rope, some_h, some_v, rope.length);
    return std::pair{x - across, z - down};
  };
  for (int iteration = 0; iteration < 100; ++iteration) {
    const auto [rx, rz] = residual(h, v);
    if (std::hypot(rx, rz) < 1e-12 * rope.length) return std::pair{h, v};
    const double dh = 1e-7 * h, dv = 1e-7 * (std::abs(v) + rope.weight * rope.length);
    const auto [hx, hz] = residual(h + dh, v);
    const auto [vx, vz] = residual(h, v + dv);
    const double a = (hx - rx) / dh, b = (vx - rx) / dv, c = (hz - rz) / dh, d = (vz - rz) / dv, determinant = a * d - b * c;
    double step_h = -(d * rx - b * rz) / determinant, step_v = -(a * rz - c * rx) / determinant;
    // H stays positive, and the residual decreases
    for (int halving = 0; halving < 40; ++halving, step_h *= 0.5, step_v *= 0.5) {
      if (h + step_h <= 0.0) continue;
      const auto [nx, nz] = residual(h + step_h, v + step_v);
      if (std::hypot(nx, nz) < std::hypot(rx, rz)) break;
    }
    if (!std::isfinite(step_h) || !(h + step_h > 0.0)) return std::nullopt;
    h += step_h;
    v += step_v;
  }
  return std::nullopt;
}

std::optional<std::vector<Vec3>> catenary(const System& system, const State& state) {
  const auto rope = hanging_rope(system);
  if (!rope || (system.drag_rate() > 0.0 && system.wind != Vec3(0.0))) return std::nullopt;
  const Vec3 down = glm::normalize(system.gravity), chord = state.position.back() - state.position.front();
  const double drop = glm::dot(chord, down), across = glm::length(chord - drop * down);
  if (!(across > 1e-6 * rope->length)) return std::nullopt;
  const auto tensions = solve(*rope, across, drop);
  if (!tensions) return std::nullopt;
  const Vec3 sideways = (chord - drop * down) / across;
  std::vector<Vec3> places = state.position;
  for (std::size_t i = 1; i + 1 < places.size(); ++i) {
    const double s = rope->length * static_cast<double>(i) / static_cast<double>(places.size() - 1);
    const auto [x, z] = place_on(*rope, tensions->first, tensions->second, s);
    places[i] = state.position.front() + x * sideways + z * down;
  }
  return places;
}

}  // namespace

std::optional<Companion> exact_companion(const std::shared_ptr<const System>& system, const State& state) {
  if (system->point_count() == 0 || system->springs().empty() || !has_only_springs_weight_and_drag(*system, state)) return std::nullopt;
  const std::string contact = has_contact(*system) ? " without contact" : "";
  if (const auto line = common_line(*system, state); line && !can_collapse(*system, state))
    if (auto motion = LinearMotion::about(*system, state.position, {*line}))
      return companion_of("Exact solution" + contact, *std::move(motion));
  if (auto places = catenary(*system, state))
    return Companion{.name = "Catenary at rest" + contact, .exact = [places = *std::move(places)](State& now, double) {
                       now.position = places;
                       std::ranges::fill(now.velocity, Vec3(0.0));
                     }};
  if (system->point_count() * system->dimensions > LinearMotion::max_unknowns) return std::nullopt;
  const Forecast forecast = make_forecast(system, state, {}, false);
  if (forecast.rest.empty() || !forecast.slowest || !is_small_vibration(*system, state, forecast)) return std::nullopt;
  std::vector<Vec3> axes{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  axes.resize(static_cast<std::size_t>(system->dimensions));
  auto motion = LinearMotion::about(*system, forecast.rest, axes);
  if (!motion) return std::nullopt;
  double speed = 0.0;
  for (const Vec3& v : state.velocity) speed = std::max(speed, glm::length(v));
  if (constexpr double negligible = 1e-6; motion->drift_speed(state) > negligible * speed) return std::nullopt;
  return companion_of("Small vibrations" + contact, *std::move(motion));
}

Companion companion_of(const Settings& settings) {
  const std::string name = settings.integrator->short_name();
  const bool adapts = settings.integrator->stability == Stability::Adaptive;
  return {.name = name + ", " +
                  (is_automatic(settings) ? "tolerance " + quantity_text(automatic_tolerance(settings), "m/s", 1)
                   : adapts               ? "tolerance " + quantity_text(settings.tolerance.value_or(default_tolerance), "m", 1)
                                          : std::to_string(settings.substeps) + (settings.substeps == 1 ? " substep" : " substeps")),
          .settings = settings};
}

Companion exact_or_reference(const std::shared_ptr<const System>& system, const State& state, const Settings& settings) {
  if (auto exact = exact_companion(system, state)) return *std::move(exact);
  Settings reference = settings;
  reference.integrator = find_integrator("dop853");
  reference.substeps = 1;
  reference.tolerance = 1e-9 * std::max(bounding_box(state.position).longest_side(), 1e-6);
  Companion companion = companion_of(reference);
  companion.name = "Reference (" + std::string(reference.integrator->id) + ", " + quantity_text(*reference.tolerance, "m", 1) + ")";
  return companion;
}

}  // namespace hooke
