#include "sim/contact/contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "sim/contact/gap.h"

namespace hooke {
namespace {

// A collider that the point touches, neither moving into it nor away from it.
struct Support {
  const Obstacle* obstacle = nullptr;
  Vec3 normal{0.0};
  double curvature = 0.0;
  Vec3 velocity{0.0};                // [m/s], of the shape
  Vec3 surface{0.0};                 // [m/s], of what is touched: of the shape, and along it
  Vec3 surface_acceleration{0.0};    // [m/s^2], of what is touched, besides the shape's: as it turns
  double normal_acceleration = 0.0;  // [m/s^2], normal force over mass
  double friction() const { return obstacle->collider->friction; }
};

struct Supports {
  static constexpr int max = 4;
  std::array<Support, max> items;
  int count = 0;

  std::span<Support> all() { return {items.data(), static_cast<std::size_t>(count)}; }
  std::span<const Support> all() const { return {items.data(), static_cast<std::size_t>(count)}; }
  bool contains(const Obstacle* obstacle) const {
    return std::ranges::any_of(all(), [&](const Support& s) { return s.obstacle == obstacle; });
  }
  bool any_loaded() const {
    return std::ranges::any_of(all(), [](const Support& s) { return s.normal_acceleration > 0.0; });
  }
};

Vec3 tangential(const Vec3& normal, const Vec3& w) { return w - glm::dot(w, normal) * normal; }

// The velocity at which a surface runs below a point at x, on the side of `normal`, besides the shape's own. What turns
// carries the point along as if it were a part of it.
Vec3 relative_surface_velocity(const Obstacle& obstacle, const Vec3& normal, const Vec3& x) {
  const ColliderPath& path = obstacle.collider->path;
  Vec3 velocity = tangential(normal, path.belt);
  if (const auto* sphere = std::get_if<Sphere>(&obstacle.collider->shape)) velocity += glm::cross(path.spin, x - sphere->center);
  if (const auto* plane = std::get_if<Plane>(&obstacle.collider->shape)) velocity += glm::cross(path.spin, x - plane->point);
  return velocity;
}

// The acceleration that the supports leave of `a`: they press, N_i >= 0, no more than it takes for nothing to move into
// any of them, n_i . (a - a_i + sum N_j n_j) + (v - v_i)^2 / R_i >= 0, a_i and v_i being their own. Tried in turn: none presses, one does,
// two do; where two are not enough nothing moves.
Vec3 constrain(std::span<Support> supports, const Vec3& a, const Vec3& v) {
  const auto separation = [&](const Support& s, const Vec3& w) {
    const Vec3 relative_velocity = v - s.velocity;
    return glm::dot(s.normal, w - s.obstacle->acceleration) + s.curvature * glm::dot(relative_velocity, relative_velocity);
  };
  const auto is_feasible = [&](const Vec3& w) {
    return std::ranges::all_of(supports, [&](const Support& s) { return separation(s, w) >= -1e-12 * glm::length(a); });
  };

  for (Support& s : supports) s.normal_acceleration = 0.0;
  if (is_feasible(a)) return a;

  for (Support& s : supports) {
    const double n = -separation(s, a);
    if (n <= 0.0 || !is_feasible(a + n * s.normal)) continue;
    s.normal_acceleration = n;
    return a + n * s.normal;
  }

  for (Support& first : supports)
    for (Support& second : supports) {
      const double cosine = glm::dot(first.normal, second.normal), determinant = 1.0 - cosine * cosine;
      if (&first >= &second || determinant < 1e-12) continue;
      const double b1 = -separation(first, a), b2 = -separation(second, a);
      const double n1 = (b1 - cosine * b2) / determinant, n2 = (b2 - cosine * b1) / determinant;
      const Vec3 constrained = a + n1 * first.normal + n2 * second.normal;
      if (n1 < 0.0 || n2 < 0.0 || !is_feasible(constrained)) continue;
      first.normal_acceleration = n1;
      second.normal_acceleration = n2;
      return constrained;
    }

  for (Support& s : supports) s.normal_acceleration = std::max(0.0, -separation(s, a));
  return Vec3(0.0);
}

// One point on its way through a step.
class PointContactSolver {
 public:
  Vec3 x, v;

  PointContactSolver(std::span<const Obstacle> obstacles, double radius, const Vec3& x0, const Vec3& v0)
      : x(x0), v(v0), obstacles_(obstacles), radius_(radius) {}

  // Goes on for `duration` under the acceleration `a`. `lead` [m/s]: what the method's path starts faster than v. Returns
  // whether anything was touched.
  bool advance(const Vec3& a, const Vec3& velocity_correction, double duration);

 private:
  // A stretch of the way on which the acceleration is constant: the supports, and friction, stay as they are.
  struct Segment {
    Vec3 acceleration;
    double time;      // [s]
    bool stops;       // at the end, under friction
    bool sticks;      // to what it rests on, wherever that goes
    Support support;  // what it rests on or rubs on, the mean of several; of none: no obstacle
  };

  bool resolve_penetration();
  Supports find_supports(const Vec3& a, double duration) const;
  bool apply_velocity_correction(const Vec3& velocity_correction, const Supports& supports);
  Segment plan_segment(Supports& supports, const Vec3& a, double remaining) const;
  const Obstacle* advance_segment(Segment& segment, const Supports& supports);
  void follow_surface(const Segment& segment, const Vec3& start, const Vec3& a);
  void project_onto_supports(const Supports& supports);
  void bounce(const Obstacle& obstacle, const Vec3& a, double remaining);

  Gap gap_to(const Obstacle& obstacle) const { return hooke::gap_to(*obstacle.collider, radius_, x - obstacle.offset_at(time_)); }
  // Of the shape, and of its surface where the point is.
  Vec3 velocity_of(const Obstacle& obstacle) const {
    return obstacle.velocity_at(time_) + (applies_correction_ ? obstacle.velocity_correction : Vec3(0.0));
  }
  Vec3 surface_velocity_of(const Obstacle& obstacle, const Vec3& normal) const {
    return velocity_of(obstacle) + relative_surface_velocity(obstacle, normal, x - obstacle.offset_at(time_));
  }

  std::span<const Obstacle> obstacles_;
  double radius_;
  double time_ = 0.0;                // [s], since the step began
  Vec3 velocity_correction_{0.0};    // [m/s], that v is ahead by
  bool applies_correction_ = false;  // whether v and the velocities of obstacles are to be taken with their leads
};

bool PointContactSolver::advance(const Vec3& a, const Vec3& velocity_correction, double duration) {
  bool touched = resolve_penetration();
  Supports supports = find_supports(a, duration);
  constrain(supports.all(), a, v);
  touched = apply_velocity_correction(velocity_correction, supports) || touched;

  constexpr int max_segments = 64;
  double remaining = duration;
  for (int segments = 0; remaining > 0.0 && segments < max_segments; ++segments) {
    supports = find_supports(a, remaining);
    Segment segment = plan_segment(supports, a, remaining);
    const Vec3 start = x;
    const double speed = glm::length(v - segment.support.surface);
    const Obstacle* hit = advance_segment(segment, supports);
    remaining -= segment.time;
    touched = touched || hit != nullptr || supports.any_loaded();

    if (hit != nullptr) {
      bounce(*hit, a, remaining);
    } else if (x != start) {
      const Obstacle* carrier = segment.support.obstacle;
      const Vec3 surface = carrier != nullptr ? surface_velocity_of(*carrier, segment.support.normal) : Vec3(0.0);
      const bool stands = segment.sticks || (segment.stops && glm::length(v - surface) <= 1e-9 * speed);
      const bool is_curved = segment.support.curvature > 0.0;
      if (is_curved && (!stands || surface != Vec3(0.0))) follow_surface(segment, start, a);
      if (stands) {
        v = surface_velocity_of(*carrier, is_curved ? gap_to(*carrier).normal : segment.support.normal);
        velocity_correction_ = carrier->velocity_correction;
      }
      project_onto_supports(supports);
    }
  }

  resolve_penetration();
  v -= velocity_correction_;
  return touched;
}

// Out of what it is in, by the shortest way.
bool PointContactSolver::resolve_penetration() {
  constexpr int max_rounds = 8;
  bool was_penetrating = false;
  for (int round = 0; round < max_rounds; ++round) {
    bool penetrating = false;
    for (const Obstacle& obstacle : obstacles_) {
      const Gap gap = gap_to(obstacle);
      if (gap.distance >= -contact_tolerance(x)) continue;
      x -= gap.distance * gap.normal;
      penetrating = was_penetrating = true;
    }
    if (!penetrating) break;
  }
  return was_penetrating;
}

Supports PointContactSolver::find_supports(const Vec3& a, double duration) const {
  Supports supports;
  const double velocity_tolerance = 1e-12 * (glm::length(v) + duration * glm::length(a));
  for (const Obstacle& obstacle : obstacles_) {
    const Gap gap = gap_to(obstacle);
    if (gap.distance > contact_tolerance(x)) continue;
    // where it moves, its velocity is known to the rounding of the time
    const Vec3 velocity = velocity_of(obstacle);
    const double obstacle_tolerance = 1e-9 * (glm::length(velocity) + duration * glm::length(obstacle.acceleration));
    if (std::abs(glm::dot(v - velocity, gap.normal)) > velocity_tolerance + obstacle_tolerance || supports.count == Supports::max) continue;
    const Vec3 surface = surface_velocity_of(obstacle, gap.normal);
    const Vec3 surface_acceleration =
        glm::cross(obstacle.collider->path.spin, surface - velocity - tangential(gap.normal, obstacle.collider->path.belt));
    supports.items[supports.count++] = {&obstacle, gap.normal, gap.curvature, velocity, surface, surface_acceleration};
  }
  return supports;
}

// A flight starts as the method's own path does, but never into what the point touches; so does a slide without
// friction. What rests, or rubs, starts with its own velocity: the lead comes from forces that the supports bear.
// What bears it may have a lead of its own, which it goes along with. Returns whether anything was left out.
bool PointContactSolver::apply_velocity_correction(const Vec3& velocity_correction, const Supports& supports) {
  applies_correction_ = true;
  for (const Support& s : supports.all()) {
    if (!(s.normal_acceleration > 0.0) || !(s.friction() > 0.0 || v == s.surface)) continue;
    velocity_correction_ = s.obstacle->velocity_correction;
    v += velocity_correction_;
    return true;
  }
  velocity_correction_ = velocity_correction;
  for (const Support& s : supports.all()) {
    const double separation = glm::dot(velocity_correction_ - s.obstacle->velocity_correction, s.normal);
    if (separation < 0.0 || s.normal_acceleration > 0.0) velocity_correction_ -= separation * s.normal;
  }
  v += velocity_correction_;
  return velocity_correction_ != velocity_correction;
}

// What the point rests or rubs on: one of the supports that press, a curved one if there is, with the mean of what they
// move at, weighed by friction.
Support combine_supports(const Supports& supports) {
  Support combined;
  double weight = 0.0;
  Vec3 surface(0.0), surface_acceleration(0.0), acceleration(0.0);
  bool identical = true;
  for (const Support& s : supports.all()) {
    if (!(s.normal_acceleration > 0.0)) continue;
    identical = identical && (combined.obstacle == nullptr ||
                              (s.surface == combined.surface && s.surface_acceleration == combined.surface_acceleration));
    if (combined.obstacle == nullptr || s.curvature > 0.0) combined = s;
    weight += s.friction() * s.normal_acceleration;
    surface += s.friction() * s.normal_acceleration * s.surface;
    surface_acceleration += s.friction() * s.normal_acceleration * s.surface_acceleration;
  }
  if (identical || weight == 0.0) return combined;
  combined.surface = surface / weight;
  combined.surface_acceleration = surface_acceleration / weight;
  return combined;
}

// Friction takes mu N against the motion past the surface or, where there is none, against the drive as far as it reaches.
PointContactSolver::Segment PointContactSolver::plan_segment(Supports& supports, const Vec3& a, double remaining) const {
  const Vec3 constrained = constrain(supports.all(), a, v);
  Segment segment{constrained, remaining, false, false, {}};
  if (!supports.any_loaded()) return segment;

  double max_friction = 0.0;  // [m/s^2]
  for (const Support& s : supports.all()) max_friction += s.friction() * s.normal_acceleration;
  segment.support = combine_supports(supports);

  // relative to the shape that it runs on
  const Support& carrier = segment.support;
  const Vec3 shape_acceleration = carrier.obstacle->acceleration, drive = constrained - shape_acceleration;
  const Vec3 tangential_drive = carrier.curvature > 0.0 ? tangential(carrier.normal, drive) : drive;
  const Vec3 surface_acceleration =
      carrier.curvature > 0.0 ? tangential(carrier.normal, carrier.surface_acceleration) : carrier.surface_acceleration;
  const Vec3 slip_velocity = v - carrier.surface;
  const double speed = glm::length(slip_velocity), required_friction = glm::length(tangential_drive - surface_acceleration);
  const double min_speed = carrier.surface == Vec3(0.0) ? 0.0 : 1e-12 * (glm::length(v) + glm::length(carrier.surface));
  if (speed <= min_speed) {
    segment.sticks = required_friction <= max_friction + 1e-12 * glm::length(a);
    segment.acceleration =
        segment.sticks ? surface_acceleration
                       : surface_acceleration + (tangential_drive - surface_acceleration) * (1.0 - max_friction / required_friction);
  } else {
    segment.acceleration = tangential_drive - max_friction / speed * slip_velocity;
    const double deceleration = -glm::dot(segment.acceleration - surface_acceleration, slip_velocity) / speed;
    segment.stops = deceleration * remaining >= speed;
    if (segment.stops) segment.time = speed / deceleration;
  }

  // no further on a curved surface than an eighth of its radius
  const double arc_angle =
      carrier.curvature * segment.time * (glm::length(v - carrier.velocity) + remaining * glm::length(segment.acceleration));
  if (arc_angle > 0.125) {
    segment.time *= 0.125 / arc_angle;
    segment.stops = false;
  }
  segment.acceleration += shape_acceleration;
  return segment;
}

// Goes the leg, or as far as the first hit on anything but its supports: then the leg ends there.
const Obstacle* PointContactSolver::advance_segment(Segment& segment, const Supports& supports) {
  const Obstacle* hit = nullptr;
  for (const Obstacle& obstacle : obstacles_) {
    if (supports.contains(&obstacle)) continue;
    const Parabola relative{x - obstacle.offset_at(time_), v - velocity_of(obstacle), segment.acceleration - obstacle.acceleration};
    const auto impact = first_impact(*obstacle.collider, radius_, relative, segment.time);
    if (!impact || (hit != nullptr && *impact == segment.time)) continue;
    segment.time = *impact;
    hit = &obstacle;
  }

  const Parabola path{x, v, segment.acceleration};
  x = path.position(segment.time);
  v = path.velocity(segment.time);
  time_ += segment.time;
  return hit;
}

// From the tangent plane at `start` down to the surface along the old normal, and the velocity likewise: the second
// order scheme RATTLE (Andersen 1983). Friction took the normal force at the start; here it takes the mean.
void PointContactSolver::follow_surface(const Segment& segment, const Vec3& start, const Vec3& a) {
  const Support& surface = segment.support;
  const Obstacle& obstacle = *surface.obstacle;
  const Vec3 shape_velocity = velocity_of(obstacle), relative_acceleration = a - obstacle.acceleration;
  const double radius = 1.0 / surface.curvature;
  const Vec3 displacement = x - start - (obstacle.offset_at(time_) - obstacle.offset_at(time_ - segment.time));
  const double normal_displacement =
      -glm::dot(displacement, displacement) / (radius + std::sqrt(radius * radius - glm::dot(displacement, displacement)));
  x += normal_displacement * surface.normal;
  const Vec3 normal = surface.normal + (displacement + normal_displacement * surface.normal) / radius;
  const Vec3 relative_velocity =
      tangential(normal, v - shape_velocity +
                             (normal_displacement / segment.time + 0.5 * segment.time * glm::dot(relative_acceleration, surface.normal)) *
                                 surface.normal);
  const Vec3 surface_velocity = relative_surface_velocity(obstacle, normal, x - obstacle.offset_at(time_));
  v = shape_velocity + relative_velocity;

  const Vec3 slip_velocity = relative_velocity - surface_velocity;
  const double speed = glm::length(slip_velocity);
  const double normal_acceleration =
      std::max(0.0, -glm::dot(relative_acceleration, normal) - surface.curvature * glm::dot(relative_velocity, relative_velocity));
  const double speed_loss = 0.5 * segment.time * surface.friction() * (normal_acceleration - surface.normal_acceleration);
  if (speed > 0.0) v = shape_velocity + surface_velocity + std::max(0.0, 1.0 - speed_loss / speed) * slip_velocity;
}

// Clears away what round-off, or a bent surface, left of motion out of the supports. One that the point has slid off
// the edge of, where the nearest surface is another one, does not hold it back.
void PointContactSolver::project_onto_supports(const Supports& supports) {
  for (const Support& s : supports.all()) {
    if (s.normal_acceleration == 0.0) continue;
    const Gap gap = gap_to(*s.obstacle);
    if (std::abs(gap.distance) > contact_tolerance(x) || glm::dot(gap.normal, s.normal) < 0.9) continue;
    x -= gap.distance * gap.normal;
    v -= glm::dot(v - velocity_of(*s.obstacle), gap.normal) * gap.normal;
    velocity_correction_ -= glm::dot(velocity_correction_ - s.obstacle->velocity_correction, gap.normal) * gap.normal;
  }
}

// Restitution along the normal, Coulomb's impulse across it, both of the velocity past the surface.
void PointContactSolver::bounce(const Obstacle& obstacle, const Vec3& a, double remaining) {
  const Collider& collider = *obstacle.collider;
  const Gap gap = gap_to(obstacle);
  x -= gap.distance * gap.normal;

  const Vec3 shape_velocity = velocity_of(obstacle), surface = surface_velocity_of(obstacle, gap.normal);
  const double approach = std::min(0.0, glm::dot(v - surface, gap.normal));
  double rebound = -collider.restitution * approach;
  Vec3 tangential_velocity = tangential(gap.normal, v - surface);
  const double speed = glm::length(tangential_velocity);
  if (speed > 0.0) tangential_velocity *= std::max(0.0, 1.0 - collider.friction * (rebound - approach) / speed);

  // all bounces to come take 2 v / (N (1 - e)): if that is within the step, they are over
  const Vec3 relative_velocity = tangential_velocity + tangential(gap.normal, surface - shape_velocity);
  const double normal_acceleration =
      -glm::dot(a - obstacle.acceleration, gap.normal) - gap.curvature * glm::dot(relative_velocity, relative_velocity);
  if (normal_acceleration > 0.0 && 2.0 * rebound <= remaining * normal_acceleration * (1.0 - collider.restitution)) rebound = 0.0;
  v = surface + tangential_velocity + rebound * gap.normal;
  if (rebound == 0.0) velocity_correction_ = obstacle.velocity_correction;
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
    obstacle.velocity_correction = (end - obstacle.offset) / h - obstacle.velocity - 0.5 * h * obstacle.acceleration;
  }
  return obstacles;
}

// False when the point is sure to miss it on its way from x0 to x1.
bool may_touch(const Obstacle& obstacle, double radius, const Vec3& x0, const Vec3& x1, double bulge, double h) {
  const double more = 0.125 * h * h * glm::length(obstacle.acceleration);
  return may_touch(*obstacle.collider, radius, x0 - obstacle.offset, x1 - obstacle.offset_at(h), bulge + more);
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
    const Vec3 a = (v1 - v0) / h, velocity_correction = (x1 - x0) / h - v0 - 0.5 * h * a;
    PointContactSolver solver(obstacles, radius, x0, v0);
    if (!solver.advance(a, velocity_correction, h)) continue;

    touched = true;
    // what comes on top of the forces' work
    if (plan.colliders_move)
      motion.collider_work += plan.mass[i] * (0.5 * (glm::dot(solver.v, solver.v) - glm::dot(v1, v1)) - glm::dot(a, solver.x - x1));
    for (int c = 0; c < plan.dimensions; ++c) {
      motion.x[c * n + i] = solver.x[c];
      motion.v[c * n + i] = solver.v[c];
    }
  }
  return touched;
}

}  // namespace hooke
