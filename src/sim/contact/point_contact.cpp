#include "sim/contact/point_contact.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/impulse.h"

namespace hooke {

bool PointContactSolver::advance(const Vec3& a, const Vec3& velocity_correction, double duration) {
  const Vec3 start_of_step = x;
  bool touched = resolve_penetration();
  push_out = x - start_of_step;
  Supports supports = find_supports(a, duration);
  constrain(supports.all(), a, v);
  touched = apply_velocity_correction(velocity_correction, supports) || touched;

  Vec3 start_velocity = v;
  double remaining = duration;
  for (int segments = 0; remaining > 0.0 && segments < max_path_segments; ++segments) {
    supports = find_supports(a, remaining);
    const Vec3 held = held_acceleration(a);
    Segment segment = plan_segment(supports, held, remaining, segments == 0 ? friction_lag_ : 0.0);
    // What leaves its supports ends as in a flight. Otherwise its correction in the next step, along the acceleration, would lead back into
    // them: an impact in each step.
    if (velocity_lag_ > 0.0 && !supports.any_loaded() && held == a) velocity_correction_ = velocity_correction;
    const Vec3 start = x;
    if (segment.sticks) v = segment.support.surface;
    v += segment.velocity_correction;
    velocity_correction_ += segment.velocity_correction;
    start_velocity += segment.velocity_correction;
    const double speed = glm::length(v - segment.support.surface);
    const Obstacle* hit = advance_segment(segment, supports);
    remaining -= segment.time;
    if (!touched && hit != nullptr && !supports.any_loaded()) first_touch = time_;
    touched = touched || hit != nullptr || supports.any_loaded();

    if (hit != nullptr) {
      first_impact = std::min(first_impact, time_);
      bounce(*hit, a, remaining);
    } else if (x != start) {
      const Obstacle* carrier = segment.support.obstacle;
      const Vec3 surface = carrier != nullptr ? surface_velocity_of(*carrier, segment.support.normal) : Vec3(0.0);
      const bool is_at_rest = segment.sticks || (segment.stops && glm::length(v - surface) <= 1e-9 * speed);
      const bool is_curved = segment.support.curvature > 0.0;
      if (is_curved && (!is_at_rest || surface != Vec3(0.0))) follow_surface(segment, start, a);
      if (is_at_rest) {
        v = surface_velocity_of(*carrier, is_curved ? gap_to(*carrier).normal : segment.support.normal);
        velocity_correction_ = carrier->velocity_correction;
      }
      // past an edge, as in a flight
      const bool touches = project_onto_supports(supports);
      if (velocity_lag_ != 0.0 && !touches && supports.any_loaded()) velocity_correction_ = velocity_correction;
    }
  }

  resolve_penetration();
  gained = 0.5 * (glm::dot(v, v) - glm::dot(start_velocity, start_velocity));
  v -= velocity_correction_;
  return touched;
}

// Without what a sticky plane balances.
Vec3 PointContactSolver::held_acceleration(const Vec3& a) const {
  if (sticks_to_ == nullptr) return a;
  const Vec3& normal = std::get<Plane>(sticks_to_->collider->shape).normal;
  const double pull = glm::dot(normal, a - sticks_to_->acceleration);
  return pull > 0.0 && pull <= adhesion ? a - pull * normal : a;
}

// Moves the point out of obstacles that it penetrates, along the normal.
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
    // while the support moves, its velocity is known up to the rounding of the time
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

// A flight, and a slide without friction, start with the velocity of the method's path, but never into what the point touches.
// A point at rest, or under friction, starts with its own velocity: the correction comes from forces that the supports balance (that of a
// symplectic method follows from the forces that remain, in plan_segment).
// It follows the correction of its support. Returns whether any part was left out.
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

namespace {

// Whether friction, which exceeds what holds the point by `margin` [m/s^2], stops it within the step and the tolerance of contact, whatever
// the direction in which it is driven. Its path there turns into that direction in ever shorter segments without end.
bool is_about_to_stop(double speed, double margin, double remaining, const Vec3& x) {
  return speed <= margin * remaining && speed * speed <= margin * contact_tolerance(x);
}

}  // namespace

// Friction of mu N opposes the motion relative to the surface or, without such motion, the driving force up to its magnitude. With a
// `friction_lag`, the motion is the method's own for the rest of the step: with x' = x + h (v + v') / 2 from forces at x, as a point under
// friction would move otherwise, vibrations along the surface grow by (h omega)^2 / 2 of their energy in each step.
PointContactSolver::Segment PointContactSolver::plan_segment(Supports& supports, const Vec3& a, double remaining,
                                                             double friction_lag) const {
  const Vec3 constrained = constrain(supports.all(), a, v);
  Segment segment{constrained, remaining, false, false, {}, Vec3(0.0)};
  if (!supports.any_loaded()) return segment;

  double max_friction = 0.0;  // [m/s^2]
  for (const Support& s : supports.all()) max_friction += s.friction() * s.normal_acceleration;
  segment.support = combine_supports(supports);

  // relative to the shape on which it slides
  const Support& carrier = segment.support;
  const Vec3 shape_acceleration = carrier.obstacle->acceleration, drive = constrained - shape_acceleration;
  const Vec3 tangential_drive = carrier.curvature > 0.0 ? tangential(carrier.normal, drive) : drive;
  const Vec3 surface_acceleration =
      carrier.curvature > 0.0 ? tangential(carrier.normal, carrier.surface_acceleration) : carrier.surface_acceleration;
  const Vec3 slip_velocity = v - carrier.surface;
  const double speed = glm::length(slip_velocity), required_friction = glm::length(tangential_drive - surface_acceleration);
  const double min_speed = carrier.surface == Vec3(0.0) ? 0.0 : 1e-12 * (glm::length(v) + glm::length(carrier.surface));
  if (friction_lag != 0.0 && max_friction > 0.0) {
    // v' = v + h (d - mu N v' / |v'|) with the drive d, and x' = x + h v'
    const Vec3 drive_on_surface = tangential_drive - surface_acceleration, driven = slip_velocity + remaining * drive_on_surface;
    const double driven_speed = glm::length(driven), speed_loss = remaining * max_friction;
    segment.sticks = driven_speed <= speed_loss + 1e-12 * remaining * glm::length(a);
    segment.acceleration = surface_acceleration;
    if (!segment.sticks) {
      const Vec3 change = remaining * drive_on_surface - speed_loss / driven_speed * driven;
      segment.acceleration += change / remaining;
      segment.velocity_correction = friction_lag * change;
    }
  } else if (speed <= min_speed || is_about_to_stop(speed, max_friction - required_friction, remaining, x)) {
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

  // on a curved surface up to where it no longer presses on the point, by the rate at which its force falls now, and at most an eighth of
  // its radius
  const Vec3 along = v - carrier.velocity;
  const double falls =
      carrier.curvature * (glm::dot(along, a - shape_acceleration) + 2.0 * glm::dot(along, segment.acceleration));  // [m/s^3]
  if (!segment.sticks && falls * segment.time > carrier.normal_acceleration) {
    segment.time = carrier.normal_acceleration / falls;
    segment.stops = false;
  }
  const double arc_angle = carrier.curvature * segment.time * (glm::length(along) + remaining * glm::length(segment.acceleration));
  if (arc_angle > 0.125) {
    segment.time *= 0.125 / arc_angle;
    segment.stops = false;
  }
  segment.acceleration += shape_acceleration;
  return segment;
}

// Advances by the segment, or up to where the face of a box ends on which the point rests or slides, or up to the first impact on
// anything but its supports: then the segment ends there.
const Obstacle* PointContactSolver::advance_segment(Segment& segment, const Supports& supports) {
  const auto relative_path = [&](const Obstacle& obstacle) {
    return Parabola{x - obstacle.offset_at(time_), v - velocity_of(obstacle), segment.acceleration - obstacle.acceleration};
  };
  const Obstacle* hit = nullptr;
  for (const Support& s : supports.all()) {
    if (!(s.normal_acceleration > 0.0) || moves(*s.obstacle)) continue;
    segment.time = time_on_face(*s.obstacle->collider, relative_path(*s.obstacle), segment.time);
  }
  for (const Obstacle& obstacle : obstacles_) {
    if (supports.contains(&obstacle)) continue;
    const auto impact = hooke::first_impact(*obstacle.collider, radius_, relative_path(obstacle), segment.time);
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
  const double normal_acceleration = std::max(0.0, -glm::dot(relative_acceleration, normal) - surface.centripetal(relative_velocity));
  const double speed_loss = 0.5 * segment.time * surface.friction() * (normal_acceleration - surface.normal_acceleration);
  if (speed > 0.0) v = shape_velocity + surface_velocity + std::max(0.0, 1.0 - speed_loss / speed) * slip_velocity;
}

// Removes the motion out of the supports that round-off, or a curved surface, leaves. A support whose edge the point has
// passed, so that another surface is nearest, is ignored. Returns whether the point still touches any that is loaded.
bool PointContactSolver::project_onto_supports(const Supports& supports) {
  bool touches = false;
  for (const Support& s : supports.all()) {
    if (s.normal_acceleration == 0.0) continue;
    const Gap gap = gap_to(*s.obstacle);
    touches = touches || gap.distance <= contact_tolerance(x);
    if (std::abs(gap.distance) > contact_tolerance(x) || glm::dot(gap.normal, s.normal) < 0.9) continue;
    x -= gap.distance * gap.normal;
    v -= glm::dot(v - velocity_of(*s.obstacle), gap.normal) * gap.normal;
    velocity_correction_ -= glm::dot(velocity_correction_ - s.obstacle->velocity_correction, gap.normal) * gap.normal;
  }
  return touches;
}

// Restitution along the normal and the Coulomb impulse in the tangential direction, both for the velocity relative to the surface.
void PointContactSolver::bounce(const Obstacle& obstacle, const Vec3& a, double remaining) {
  const Collider& collider = *obstacle.collider;
  const Gap gap = gap_to(obstacle);
  x -= gap.distance * gap.normal;

  const Vec3 shape_velocity = velocity_of(obstacle), surface = surface_velocity_of(obstacle, gap.normal);
  const double approach = std::min(0.0, glm::dot(v - surface, gap.normal));
  double rebound = -collider.restitution * approach;
  Vec3 tangential_velocity = tangential(gap.normal, v - surface);
  ContactImpulse impulse;  // per mass
  change_impulse(impulse, rebound - approach, gap.normal, collider.friction, tangential_velocity, 1.0);
  tangential_velocity += impulse.friction;

  // all further bounces take 2 v / (N (1 - e)): if that is within the step, the point comes to rest
  const Vec3 relative_velocity = tangential_velocity + tangential(gap.normal, surface - shape_velocity);
  const double normal_acceleration =
      -glm::dot(a - obstacle.acceleration, gap.normal) - gap.curvature * glm::dot(relative_velocity, relative_velocity);
  if (normal_acceleration > 0.0 && 2.0 * rebound <= remaining * normal_acceleration * (1.0 - collider.restitution)) rebound = 0.0;
  v = surface + tangential_velocity + rebound * gap.normal;
  if (rebound > 0.0) return;
  if (adhesion > 0.0 && std::holds_alternative<Plane>(collider.shape)) sticks_to_ = &obstacle;
  // with a lag, as at the start of a step: on an edge, there may be an impact in each
  if (velocity_lag_ == 0.0 || collider.friction > 0.0 || tangential_velocity == Vec3(0.0))
    velocity_correction_ = obstacle.velocity_correction;
  else
    velocity_correction_ -= glm::dot(velocity_correction_ - obstacle.velocity_correction, gap.normal) * gap.normal;
}

}  // namespace hooke
