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
  const Obstacle* obstacle = nullptr;
  Vec3 normal{0.0};
  double curvature = 0.0;
  Vec3 velocity{0.0};      // [m/s], of the shape
  Vec3 surface{0.0};       // [m/s], of what is touched: of the shape, and along it
  Vec3 surface_bend{0.0};  // [m/s^2], of what is touched, besides the shape's: as it turns
  double pressing = 0.0;   // [m/s^2], normal force over mass
  double friction() const { return obstacle->collider->friction; }
};

struct Supports {
  static constexpr int most = 4;
  std::array<Support, most> items;
  int count = 0;

  std::span<Support> all() { return {items.data(), static_cast<std::size_t>(count)}; }
  std::span<const Support> all() const { return {items.data(), static_cast<std::size_t>(count)}; }
  bool include(const Obstacle* obstacle) const {
    return std::ranges::any_of(all(), [&](const Support& s) { return s.obstacle == obstacle; });
  }
  bool press() const {
    return std::ranges::any_of(all(), [](const Support& s) { return s.pressing > 0.0; });
  }
};

Vec3 across(const Vec3& normal, const Vec3& w) { return w - glm::dot(w, normal) * normal; }

// The velocity at which a surface runs below a point at x, on the side of `normal`, besides the shape's own. What turns
// carries the point along as if it were a part of it.
Vec3 running(const Obstacle& obstacle, const Vec3& normal, const Vec3& x) {
  const ColliderPath& path = obstacle.collider->path;
  Vec3 velocity = across(normal, path.belt);
  if (const auto* sphere = std::get_if<Sphere>(&obstacle.collider->shape)) velocity += glm::cross(path.spin, x - sphere->center);
  if (const auto* plane = std::get_if<Plane>(&obstacle.collider->shape)) velocity += glm::cross(path.spin, x - plane->point);
  return velocity;
}

// The acceleration that the supports leave of `a`: they press, N_i >= 0, no more than it takes for nothing to move into
// any of them, n_i . (a - a_i + sum N_j n_j) + (v - v_i)^2 / R_i >= 0, a_i and v_i being their own. Tried in turn: none presses, one does,
// two do; where two are not enough nothing moves.
Vec3 constrain(std::span<Support> supports, const Vec3& a, const Vec3& v) {
  const auto outwards = [&](const Support& s, const Vec3& w) {
    const Vec3 past = v - s.velocity;
    return glm::dot(s.normal, w - s.obstacle->acceleration) + s.curvature * glm::dot(past, past);
  };
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

  Traveller(std::span<const Obstacle> obstacles, double radius, const Vec3& x0, const Vec3& v0)
      : x(x0), v(v0), obstacles_(obstacles), radius_(radius) {}

  // Goes on for `duration` under the acceleration `a`. `lead` [m/s]: what the method's path starts faster than v. Returns
  // whether anything was touched.
  bool travel(const Vec3& a, const Vec3& lead, double duration);

 private:
  // A stretch of the way on which the acceleration is constant: the supports, and friction, stay as they are.
  struct Leg {
    Vec3 acceleration;
    double time;       // [s]
    bool stops;        // at the end, under friction
    bool sticks;       // to what it rests on, wherever that goes
    Support pressing;  // what it rests on or rubs on, the mean of several; of none: no obstacle
  };

  bool leave_insides();
  Supports find_supports(const Vec3& a, double duration) const;
  bool take_up(const Vec3& lead, const Supports& supports);
  Leg plan_leg(Supports& supports, const Vec3& a, double left) const;
  const Obstacle* run(Leg& leg, const Supports& supports);
  void follow_surface(const Leg& leg, const Vec3& start, const Vec3& a);
  void stay_on(const Supports& supports);
  void bounce(const Obstacle& obstacle, const Vec3& a, double left);

  Gap gap_to(const Obstacle& obstacle) const { return hooke::gap_to(*obstacle.collider, radius_, x - obstacle.offset_after(time_)); }
  // Of the shape, and of its surface where the point is.
  Vec3 velocity_of(const Obstacle& obstacle) const { return obstacle.velocity_after(time_) + (leads_ ? obstacle.lead : Vec3(0.0)); }
  Vec3 surface_of(const Obstacle& obstacle, const Vec3& normal) const {
    return velocity_of(obstacle) + running(obstacle, normal, x - obstacle.offset_after(time_));
  }

  std::span<const Obstacle> obstacles_;
  double radius_;
  double time_ = 0.0;   // [s], since the step began
  Vec3 lead_{0.0};      // [m/s], that v is ahead by
  bool leads_ = false;  // whether v and the velocities of obstacles are to be taken with their leads
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
    const double speed = glm::length(v - leg.pressing.surface);
    const Obstacle* hit = run(leg, supports);
    left -= leg.time;
    touched = touched || hit != nullptr || supports.press();

    if (hit != nullptr) {
      bounce(*hit, a, left);
    } else if (x != start) {
      const Obstacle* under = leg.pressing.obstacle;
      const Vec3 surface = under != nullptr ? surface_of(*under, leg.pressing.normal) : Vec3(0.0);
      const bool stands = leg.sticks || (leg.stops && glm::length(v - surface) <= 1e-9 * speed);
      const bool is_curved = leg.pressing.curvature > 0.0;
      if (is_curved && (!stands || surface != Vec3(0.0))) follow_surface(leg, start, a);
      if (stands) {
        v = surface_of(*under, is_curved ? gap_to(*under).normal : leg.pressing.normal);
        lead_ = under->lead;
      }
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
    for (const Obstacle& obstacle : obstacles_) {
      const Gap gap = gap_to(obstacle);
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
  for (const Obstacle& obstacle : obstacles_) {
    const Gap gap = gap_to(obstacle);
    if (gap.distance > touching(x)) continue;
    // where it moves, its velocity is known to the rounding of the time
    const Vec3 velocity = velocity_of(obstacle);
    const double moving = 1e-9 * (glm::length(velocity) + duration * glm::length(obstacle.acceleration));
    if (std::abs(glm::dot(v - velocity, gap.normal)) > still + moving || supports.count == Supports::most) continue;
    const Vec3 surface = surface_of(obstacle, gap.normal);
    const Vec3 bend = glm::cross(obstacle.collider->path.spin, surface - velocity - across(gap.normal, obstacle.collider->path.belt));
    supports.items[supports.count++] = {&obstacle, gap.normal, gap.curvature, velocity, surface, bend};
  }
  return supports;
}

// A flight starts as the method's own path does, but never into what the point touches; so does a slide without
// friction. What rests, or rubs, starts with its own velocity: the lead comes from forces that the supports bear.
// What bears it may have a lead of its own, which it goes along with. Returns whether anything was left out.
bool Traveller::take_up(const Vec3& lead, const Supports& supports) {
  leads_ = true;
  for (const Support& s : supports.all()) {
    if (!(s.pressing > 0.0) || !(s.friction() > 0.0 || v == s.surface)) continue;
    lead_ = s.obstacle->lead;
    v += lead_;
    return true;
  }
  lead_ = lead;
  for (const Support& s : supports.all()) {
    const double outwards = glm::dot(lead_ - s.obstacle->lead, s.normal);
    if (outwards < 0.0 || s.pressing > 0.0) lead_ -= outwards * s.normal;
  }
  v += lead_;
  return lead_ != lead;
}

// What the point rests or rubs on: one of the supports that press, a curved one if there is, with the mean of what they
// move at, weighed by friction.
Support meant_by(const Supports& supports) {
  Support meant;
  double weight = 0.0;
  Vec3 surface(0.0), bend(0.0), acceleration(0.0);
  bool alike = true;
  for (const Support& s : supports.all()) {
    if (!(s.pressing > 0.0)) continue;
    alike = alike && (meant.obstacle == nullptr || (s.surface == meant.surface && s.surface_bend == meant.surface_bend));
    if (meant.obstacle == nullptr || s.curvature > 0.0) meant = s;
    weight += s.friction() * s.pressing;
    surface += s.friction() * s.pressing * s.surface;
    bend += s.friction() * s.pressing * s.surface_bend;
  }
  if (alike || weight == 0.0) return meant;
  meant.surface = surface / weight;
  meant.surface_bend = bend / weight;
  return meant;
}

// Friction takes mu N against the motion past the surface or, where there is none, against the drive as far as it reaches.
Traveller::Leg Traveller::plan_leg(Supports& supports, const Vec3& a, double left) const {
  const Vec3 constrained = constrain(supports.all(), a, v);
  Leg leg{constrained, left, false, false, {}};
  if (!supports.press()) return leg;

  double most = 0.0;  // [m/s^2]
  for (const Support& s : supports.all()) most += s.friction() * s.pressing;
  leg.pressing = meant_by(supports);

  // relative to the shape that it runs on
  const Support& under = leg.pressing;
  const Vec3 own = under.obstacle->acceleration, drive = constrained - own;
  const Vec3 past = under.curvature > 0.0 ? across(under.normal, drive) : drive;
  const Vec3 carried = under.curvature > 0.0 ? across(under.normal, under.surface_bend) : under.surface_bend;
  const Vec3 slide = v - under.surface;
  const double speed = glm::length(slide), pull = glm::length(past - carried);
  const double least_speed = under.surface == Vec3(0.0) ? 0.0 : 1e-12 * (glm::length(v) + glm::length(under.surface));
  if (speed <= least_speed) {
    leg.sticks = pull <= most + 1e-12 * glm::length(a);
    leg.acceleration = leg.sticks ? carried : carried + (past - carried) * (1.0 - most / pull);
  } else {
    leg.acceleration = past - most / speed * slide;
    const double slowing = -glm::dot(leg.acceleration - carried, slide) / speed;
    leg.stops = slowing * left >= speed;
    if (leg.stops) leg.time = speed / slowing;
  }

  // no further on a curved surface than an eighth of its radius
  const double way = under.curvature * leg.time * (glm::length(v - under.velocity) + left * glm::length(leg.acceleration));
  if (way > 0.125) {
    leg.time *= 0.125 / way;
    leg.stops = false;
  }
  leg.acceleration += own;
  return leg;
}

// Goes the leg, or as far as the first hit on anything but its supports: then the leg ends there.
const Obstacle* Traveller::run(Leg& leg, const Supports& supports) {
  const Obstacle* hit = nullptr;
  for (const Obstacle& obstacle : obstacles_) {
    if (supports.include(&obstacle)) continue;
    const Parabola relative{x - obstacle.offset_after(time_), v - velocity_of(obstacle), leg.acceleration - obstacle.acceleration};
    const auto impact = first_impact(*obstacle.collider, radius_, relative, leg.time);
    if (!impact || (hit != nullptr && *impact == leg.time)) continue;
    leg.time = *impact;
    hit = &obstacle;
  }

  const Parabola path{x, v, leg.acceleration};
  x = path.position(leg.time);
  v = path.velocity(leg.time);
  time_ += leg.time;
  return hit;
}

// From the tangent plane at `start` down to the surface along the old normal, and the velocity likewise: the second
// order scheme RATTLE (Andersen 1983). Friction took the normal force at the start; here it takes the mean.
void Traveller::follow_surface(const Leg& leg, const Vec3& start, const Vec3& a) {
  const Support& surface = leg.pressing;
  const Obstacle& obstacle = *surface.obstacle;
  const Vec3 own = velocity_of(obstacle), pull = a - obstacle.acceleration;
  const double radius = 1.0 / surface.curvature;
  const Vec3 way = x - start - (obstacle.offset_after(time_) - obstacle.offset_after(time_ - leg.time));
  const double drop = -glm::dot(way, way) / (radius + std::sqrt(radius * radius - glm::dot(way, way)));
  x += drop * surface.normal;
  const Vec3 normal = surface.normal + (way + drop * surface.normal) / radius;
  const Vec3 past = across(normal, v - own + (drop / leg.time + 0.5 * leg.time * glm::dot(pull, surface.normal)) * surface.normal);
  const Vec3 runs = running(obstacle, normal, x - obstacle.offset_after(time_));
  v = own + past;

  const Vec3 slide = past - runs;
  const double speed = glm::length(slide);
  const double pressing = std::max(0.0, -glm::dot(pull, normal) - surface.curvature * glm::dot(past, past));
  const double slowed = 0.5 * leg.time * surface.friction() * (pressing - surface.pressing);
  if (speed > 0.0) v = own + runs + std::max(0.0, 1.0 - slowed / speed) * slide;
}

// Clears away what round-off, or a bent surface, left of motion out of the supports. One that the point has slid off
// the edge of, where the nearest surface is another one, does not hold it back.
void Traveller::stay_on(const Supports& supports) {
  for (const Support& s : supports.all()) {
    if (s.pressing == 0.0) continue;
    const Gap gap = gap_to(*s.obstacle);
    if (std::abs(gap.distance) > touching(x) || glm::dot(gap.normal, s.normal) < 0.9) continue;
    x -= gap.distance * gap.normal;
    v -= glm::dot(v - velocity_of(*s.obstacle), gap.normal) * gap.normal;
    lead_ -= glm::dot(lead_ - s.obstacle->lead, gap.normal) * gap.normal;
  }
}

// Restitution along the normal, Coulomb's impulse across it, both of the velocity past the surface.
void Traveller::bounce(const Obstacle& obstacle, const Vec3& a, double left) {
  const Collider& collider = *obstacle.collider;
  const Gap gap = gap_to(obstacle);
  x -= gap.distance * gap.normal;

  const Vec3 own = velocity_of(obstacle), surface = surface_of(obstacle, gap.normal);
  const double approach = std::min(0.0, glm::dot(v - surface, gap.normal));
  double rebound = -collider.restitution * approach;
  Vec3 along = across(gap.normal, v - surface);
  const double speed = glm::length(along);
  if (speed > 0.0) along *= std::max(0.0, 1.0 - collider.friction * (rebound - approach) / speed);

  // all bounces to come take 2 v / (N (1 - e)): if that is within the step, they are over
  const Vec3 past = along + across(gap.normal, surface - own);
  const double pressing = -glm::dot(a - obstacle.acceleration, gap.normal) - gap.curvature * glm::dot(past, past);
  if (pressing > 0.0 && 2.0 * rebound <= left * pressing * (1.0 - collider.restitution)) rebound = 0.0;
  v = surface + along + rebound * gap.normal;
  if (rebound == 0.0) lead_ = obstacle.lead;
}

// The plan's colliders in the step of h that starts at `start`.
std::span<const Obstacle> find_obstacles(const Plan& plan, double start, double h, std::vector<Obstacle>& obstacles) {
  obstacles.resize(plan.colliders.size());
  for (std::size_t c = 0; c < obstacles.size(); ++c) {
    Obstacle& obstacle = obstacles[c] = {.collider = &plan.colliders[c]};
    if (!plan.colliders_move) continue;
    const Vec3 end = plan.offset_of(c, start + h), last = plan.velocity_of(c, start + h);
    obstacle.offset = plan.offset_of(c, start);
    obstacle.velocity = plan.velocity_of(c, start);
    obstacle.acceleration = (last - obstacle.velocity) / h;
    obstacle.lead = (end - obstacle.offset) / h - obstacle.velocity - 0.5 * h * obstacle.acceleration;
  }
  return obstacles;
}

// False when the point is sure to miss it on its way from x0 to x1.
bool may_touch(const Obstacle& obstacle, double radius, const Vec3& x0, const Vec3& x1, double bulge, double h) {
  const double more = 0.125 * h * h * glm::length(obstacle.acceleration);
  return may_touch(*obstacle.collider, radius, x0 - obstacle.offset, x1 - obstacle.offset_after(h), bulge + more);
}

// of point i, whose components stand `n` apart
Vec3 vector_at(const Field& field, std::size_t n, std::size_t i, int dimensions) {
  return {field[i], field[n + i], dimensions == 3 ? field[2 * n + i] : 0.0};
}

}  // namespace

bool resolve_contacts(const Plan& plan, ContactWorkspace& before, Motion& motion, double h) {
  const auto n = static_cast<std::size_t>(plan.points);
  const std::span<const Obstacle> obstacles = find_obstacles(plan, before.time, h, before.obstacles);
  bool touched = false;
  for (std::size_t i = 0; i < n; ++i) {
    if (plan.inverse_mass[i] == 0.0) continue;
    const Vec3 x0 = vector_at(before.x, n, i, plan.dimensions), x1 = vector_at(motion.x, n, i, plan.dimensions);
    const Vec3 v0 = vector_at(before.v, n, i, plan.dimensions), v1 = vector_at(motion.v, n, i, plan.dimensions);
    const double radius = plan.radius[i], bulge = 0.125 * h * glm::length(v1 - v0);
    if (std::ranges::none_of(obstacles, [&](const Obstacle& obstacle) { return may_touch(obstacle, radius, x0, x1, bulge, h); })) continue;

    // the parabola through both positions with the mean acceleration of the step: its velocity starts ahead of v0
    const Vec3 a = (v1 - v0) / h, lead = (x1 - x0) / h - v0 - 0.5 * h * a;
    Traveller traveller(obstacles, radius, x0, v0);
    if (!traveller.travel(a, lead, h)) continue;

    touched = true;
    // what comes on top of the forces' work
    if (plan.colliders_move)
      motion.collider_work +=
          plan.mass[i] * (0.5 * (glm::dot(traveller.v, traveller.v) - glm::dot(v1, v1)) - glm::dot(a, traveller.x - x1));
    for (int c = 0; c < plan.dimensions; ++c) {
      motion.x[c * n + i] = traveller.x[c];
      motion.v[c * n + i] = traveller.v[c];
    }
  }
  return touched;
}

}  // namespace hooke
