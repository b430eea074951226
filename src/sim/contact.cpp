#include "sim/contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "sim/gap.h"

namespace hooke {
namespace {

// A collider that the point touches, neither moving into it nor away from it.
struct Support {
  const Collider* collider = nullptr;
  Vec3 normal{0.0};
  double curvature = 0.0;
  double pressing = 0.0;  // [m/s^2], normal force over mass
};

struct Supports {
  static constexpr int most = 4;
  std::array<Support, most> items;
  int count = 0;

  std::span<Support> all() { return {items.data(), static_cast<std::size_t>(count)}; }
  std::span<const Support> all() const { return {items.data(), static_cast<std::size_t>(count)}; }
  bool include(const Collider* collider) const {
    return std::ranges::any_of(all(), [&](const Support& s) { return s.collider == collider; });
  }
  bool press() const {
    return std::ranges::any_of(all(), [](const Support& s) { return s.pressing > 0.0; });
  }
};

Vec3 across(const Vec3& normal, const Vec3& w) { return w - glm::dot(w, normal) * normal; }

// The acceleration that the supports leave of `a`: they press, N_i >= 0, no more than it takes for nothing to move into
// any of them, n_i . (a + sum N_j n_j) + v^2 / R_i >= 0. Tried in turn: none presses, one does, two do; where two are
// not enough nothing moves.
Vec3 constrain(std::span<Support> supports, const Vec3& a, const Vec3& v) {
  const auto outwards = [&](const Support& s, const Vec3& w) { return glm::dot(s.normal, w) + s.curvature * glm::dot(v, v); };
  const auto nothing_moves_in = [&](const Vec3& w) {
    return std::ranges::all_of(supports, [&](const Support& s) { return outwards(s, w) >= -1e-12 * glm::length(a); });
  };

  for (Support& s : supports) s.pressing = 0.0;
  if (nothing_moves_in(a)) return a;

  for (Support& s : supports) {
    const double n = -outwards(s, a);
    if (n <= 0.0 || !nothing_moves_in(a + n * s.normal)) continue;
    s.pressing = n;
    return a + n * s.normal;
  }

  for (Support& first : supports)
    for (Support& second : supports) {
      const double cosine = glm::dot(first.normal, second.normal), determinant = 1.0 - cosine * cosine;
      if (&first >= &second || determinant < 1e-12) continue;
      const double b1 = -outwards(first, a), b2 = -outwards(second, a);
      const double n1 = (b1 - cosine * b2) / determinant, n2 = (b2 - cosine * b1) / determinant;
      const Vec3 rest = a + n1 * first.normal + n2 * second.normal;
      if (n1 < 0.0 || n2 < 0.0 || !nothing_moves_in(rest)) continue;
      first.pressing = n1;
      second.pressing = n2;
      return rest;
    }

  for (Support& s : supports) s.pressing = std::max(0.0, -outwards(s, a));
  return Vec3(0.0);
}

// One point on its way through a step.
class Traveller {
 public:
  Vec3 x, v;

  Traveller(std::span<const Collider> colliders, double radius, const Vec3& x0, const Vec3& v0)
      : x(x0), v(v0), colliders_(colliders), radius_(radius) {}

  // Goes on for `duration` under the acceleration `a`. `lead` [m/s]: what the method's path starts faster than v. Returns
  // whether anything was touched.
  bool travel(const Vec3& a, const Vec3& lead, double duration);

 private:
  // A stretch of the way on which the acceleration is constant: the supports, and friction, stay as they are.
  struct Leg {
    Vec3 acceleration;
    double time;     // [s]
    bool stops;      // at the end, under friction
    Support curved;  // the surface that it runs on, if any
  };

  bool leave_insides();
  Supports find_supports(const Vec3& a, double duration) const;
  bool take_up(const Vec3& lead, const Supports& supports);
  Leg plan_leg(Supports& supports, const Vec3& a, double left) const;
  const Collider* run(Leg& leg, const Supports& supports);
  void follow_surface(const Leg& leg, const Vec3& start, const Vec3& a);
  void stay_on(const Supports& supports);
  void bounce(const Collider& collider, const Vec3& a, double left);

  std::span<const Collider> colliders_;
  double radius_;
  Vec3 lead_{0.0};
};

bool Traveller::travel(const Vec3& a, const Vec3& lead, double duration) {
  bool touched = leave_insides();
  Supports supports = find_supports(a, duration);
  constrain(supports.all(), a, v);
  touched = take_up(lead, supports) || touched;

  constexpr int most_legs = 64;
  double left = duration;
  for (int legs = 0; left > 0.0 && legs < most_legs; ++legs) {
    supports = find_supports(a, left);
    Leg leg = plan_leg(supports, a, left);
    const Vec3 start = x;
    const double speed = glm::length(v);
    const Collider* hit = run(leg, supports);
    left -= leg.time;
    touched = touched || hit != nullptr || supports.press();

    if (hit != nullptr) {
      bounce(*hit, a, left);
    } else if (x != start) {
      if (leg.stops && glm::length(v) <= 1e-9 * speed)
        v = lead_ = Vec3(0.0);
      else if (leg.curved.collider != nullptr)
        follow_surface(leg, start, a);
      stay_on(supports);
    }
  }

  leave_insides();
  v -= lead_;
  return touched;
}

// Out of what it is in, by the shortest way.
bool Traveller::leave_insides() {
  constexpr int most_rounds = 8;
  bool was_inside = false;
  for (int round = 0; round < most_rounds; ++round) {
    bool inside = false;
    for (const Collider& collider : colliders_) {
      const Gap gap = gap_to(collider, radius_, x);
      if (gap.distance >= -touching(x)) continue;
      x -= gap.distance * gap.normal;
      inside = was_inside = true;
    }
    if (!inside) break;
  }
  return was_inside;
}

Supports Traveller::find_supports(const Vec3& a, double duration) const {
  Supports supports;
  const double still = 1e-12 * (glm::length(v) + duration * glm::length(a));
  for (const Collider& collider : colliders_) {
    const Gap gap = gap_to(collider, radius_, x);
    const bool touches = gap.distance <= touching(x) && std::abs(glm::dot(v, gap.normal)) <= still;
    if (touches && supports.count < Supports::most) supports.items[supports.count++] = {&collider, gap.normal, gap.curvature};
  }
  return supports;
}

// A flight starts as the method's own path does, but never into what the point touches; so does a slide without
// friction. What rests, or rubs, starts with its own velocity: the lead comes from forces that the supports bear.
// Returns whether anything was left out.
bool Traveller::take_up(const Vec3& lead, const Supports& supports) {
  const bool rubs = std::ranges::any_of(supports.all(), [](const Support& s) { return s.pressing > 0.0 && s.collider->friction > 0.0; });
  if (rubs || (supports.press() && v == Vec3(0.0))) return true;
  lead_ = lead;
  for (const Support& s : supports.all()) {
    const double outwards = glm::dot(lead_, s.normal);
    if (outwards < 0.0 || s.pressing > 0.0) lead_ -= outwards * s.normal;
  }
  v += lead_;
  return lead_ != lead;
}

// Friction takes mu N against the motion or, at rest, against the drive as far as it reaches.
Traveller::Leg Traveller::plan_leg(Supports& supports, const Vec3& a, double left) const {
  const Vec3 constrained = constrain(supports.all(), a, v);
  Leg leg{constrained, left, false, {}};
  if (!supports.press()) return leg;

  double most = 0.0;  // [m/s^2]
  for (const Support& s : supports.all()) {
    most += s.collider->friction * s.pressing;
    if (s.pressing > 0.0 && s.curvature > 0.0) leg.curved = s;
  }
  const Vec3 drive = across(leg.curved.normal, constrained);
  const double speed = glm::length(v), pull = glm::length(drive);
  if (speed == 0.0) {
    leg.acceleration = pull <= most + 1e-12 * glm::length(a) ? Vec3(0.0) : drive * (1.0 - most / pull);
  } else {
    leg.acceleration = drive - most / speed * v;
    const double slowing = -glm::dot(leg.acceleration, v) / speed;
    leg.stops = slowing * left >= speed;
    if (leg.stops) leg.time = speed / slowing;
  }

  // no further on a curved surface than an eighth of its radius
  const double way = leg.curved.curvature * leg.time * (speed + left * glm::length(leg.acceleration));
  if (way > 0.125) {
    leg.time *= 0.125 / way;
    leg.stops = false;
  }
  return leg;
}

// Goes the leg, or as far as the first hit on anything but its supports: then the leg ends there.
const Collider* Traveller::run(Leg& leg, const Supports& supports) {
  const Parabola path{x, v, leg.acceleration};
  const Collider* hit = nullptr;
  for (const Collider& collider : colliders_) {
    if (supports.include(&collider)) continue;
    const auto impact = first_impact(collider, radius_, path, leg.time);
    if (!impact || (hit != nullptr && *impact == leg.time)) continue;
    leg.time = *impact;
    hit = &collider;
  }

  x = path.position(leg.time);
  v = path.velocity(leg.time);
  return hit;
}

// From the tangent plane at `start` down to the surface along the old normal, and the velocity likewise: the second
// order scheme RATTLE (Andersen 1983). Friction took the normal force at the start; here it takes the mean.
void Traveller::follow_surface(const Leg& leg, const Vec3& start, const Vec3& a) {
  const Support& surface = leg.curved;
  const double radius = 1.0 / surface.curvature;
  const Vec3 way = x - start;
  const double drop = -glm::dot(way, way) / (radius + std::sqrt(radius * radius - glm::dot(way, way)));
  x += drop * surface.normal;
  const Vec3 normal = surface.normal + (way + drop * surface.normal) / radius;
  v = across(normal, v + (drop / leg.time + 0.5 * leg.time * glm::dot(a, surface.normal)) * surface.normal);

  const double speed = glm::length(v), pressing = std::max(0.0, -glm::dot(a, normal) - surface.curvature * speed * speed);
  const double slowed = 0.5 * leg.time * surface.collider->friction * (pressing - surface.pressing);
  if (speed > 0.0) v *= std::max(0.0, 1.0 - slowed / speed);
}

// Clears away what round-off, or a bent surface, left of motion out of the supports. One that the point has slid off
// the edge of, where the nearest surface is another one, does not hold it back.
void Traveller::stay_on(const Supports& supports) {
  for (const Support& s : supports.all()) {
    if (s.pressing == 0.0) continue;
    const Gap gap = gap_to(*s.collider, radius_, x);
    if (std::abs(gap.distance) > touching(x) || glm::dot(gap.normal, s.normal) < 0.9) continue;
    x -= gap.distance * gap.normal;
    v = across(gap.normal, v);
    lead_ = across(gap.normal, lead_);
  }
}

// Restitution along the normal, Coulomb's impulse across it.
void Traveller::bounce(const Collider& collider, const Vec3& a, double left) {
  const Gap gap = gap_to(collider, radius_, x);
  x -= gap.distance * gap.normal;

  const double approach = std::min(0.0, glm::dot(v, gap.normal));
  double rebound = -collider.restitution * approach;
  Vec3 along = across(gap.normal, v);
  const double speed = glm::length(along);
  if (speed > 0.0) along *= std::max(0.0, 1.0 - collider.friction * (rebound - approach) / speed);

  // all bounces to come take 2 v / (N (1 - e)): if that is within the step, they are over
  const double pressing = -glm::dot(a, gap.normal) - gap.curvature * glm::dot(along, along);
  if (pressing > 0.0 && 2.0 * rebound <= left * pressing * (1.0 - collider.restitution)) rebound = 0.0;
  v = along + rebound * gap.normal;
  if (rebound == 0.0) lead_ = Vec3(0.0);
}

// of point i, whose components stand `n` apart
Vec3 vector_at(const Field& field, std::size_t n, std::size_t i, int dimensions) {
  return {field[i], field[n + i], dimensions == 3 ? field[2 * n + i] : 0.0};
}

}  // namespace

bool resolve_contacts(const Plan& plan, const ContactWorkspace& before, Motion& motion, double h) {
  const auto n = static_cast<std::size_t>(plan.points);
  bool touched = false;
  for (std::size_t i = 0; i < n; ++i) {
    if (plan.inverse_mass[i] == 0.0) continue;
    const Vec3 x0 = vector_at(before.x, n, i, plan.dimensions), x1 = vector_at(motion.x, n, i, plan.dimensions);
    const Vec3 v0 = vector_at(before.v, n, i, plan.dimensions), v1 = vector_at(motion.v, n, i, plan.dimensions);
    const double radius = plan.radius[i], bulge = 0.125 * h * glm::length(v1 - v0);
    if (std::ranges::none_of(plan.colliders, [&](const Collider& collider) { return may_touch(collider, radius, x0, x1, bulge); }))
      continue;

    // the parabola through both positions with the mean acceleration of the step: its velocity starts ahead of v0
    const Vec3 a = (v1 - v0) / h, lead = (x1 - x0) / h - v0 - 0.5 * h * a;
    Traveller traveller(plan.colliders, radius, x0, v0);
    if (!traveller.travel(a, lead, h)) continue;

    touched = true;
    for (int c = 0; c < plan.dimensions; ++c) {
      motion.x[c * n + i] = traveller.x[c];
      motion.v[c * n + i] = traveller.v[c];
    }
  }
  return touched;
}

}  // namespace hooke
