// The operations of point_contact.cpp on vectors of points, on one path through it: no obstacle is penetrated, one support is loaded, and
// some segments take the whole step. A point whose path branches off anywhere is not solved. The same IEEE operations in the same order as
// there. For kernels that Highway compiles once for each vector unit: included once for each of them.
#include <type_traits>

#if defined(HOOKE_SIM_CONTACT_SLIDE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HOOKE_SIM_CONTACT_SLIDE_INL_H
#undef HOOKE_SIM_CONTACT_SLIDE_INL_H
#else
#define HOOKE_SIM_CONTACT_SLIDE_INL_H
#endif

#include <hwy/highway.h>

#include "sim/plan/plan.h"

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using PointLanes = hn::ScalableTag<double>;
using Lane = hn::Vec<PointLanes>;
using LaneMask = hn::Mask<PointLanes>;

HWY_INLINE Lane same(double number) { return hn::Set(PointLanes(), number); }
HWY_INLINE LaneMask same_if(bool value) { return hn::FirstN(PointLanes(), value ? hn::Lanes(PointLanes()) : 0); }

struct LaneVec3 {
  Lane x, y, z;
};
HWY_INLINE LaneVec3 same(const Vec3& a) { return {same(a.x), same(a.y), same(a.z)}; }
HWY_INLINE LaneVec3 sum(const LaneVec3& a, const LaneVec3& b) { return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)}; }
HWY_INLINE LaneVec3 difference(const LaneVec3& a, const LaneVec3& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
HWY_INLINE LaneVec3 times(Lane s, const LaneVec3& a) { return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)}; }
HWY_INLINE LaneVec3 over(const LaneVec3& a, Lane s) { return {hn::Div(a.x, s), hn::Div(a.y, s), hn::Div(a.z, s)}; }
HWY_INLINE Lane dot_of(const LaneVec3& a, const LaneVec3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Lane length_of(const LaneVec3& a) { return hn::Sqrt(dot_of(a, a)); }
HWY_INLINE LaneVec3 choose(LaneMask mask, const LaneVec3& yes, const LaneVec3& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}
HWY_INLINE LaneMask equal(const LaneVec3& a, const LaneVec3& b) {
  return hn::And(hn::And(hn::Eq(a.x, b.x), hn::Eq(a.y, b.y)), hn::Eq(a.z, b.z));
}
HWY_INLINE LaneVec3 tangential_to(const LaneVec3& normal, const LaneVec3& w) { return difference(w, times(dot_of(w, normal), normal)); }
// 1 + |x| + |y| + |z|
HWY_INLINE Lane magnitude(const LaneVec3& x) { return hn::Add(hn::Add(hn::Add(same(1.0), hn::Abs(x.x)), hn::Abs(x.y)), hn::Abs(x.z)); }
HWY_INLINE Lane tolerance_at(const LaneVec3& x) { return hn::Mul(same(1e-13), magnitude(x)); }

struct LaneGap {
  Lane distance;
  LaneVec3 normal;
  Lane curvature;
};
HWY_INLINE LaneGap lane_gap(const Sphere& sphere, Lane radius, const LaneVec3& x) {
  const LaneVec3 out = difference(x, same(sphere.center));
  const Lane length = length_of(out), inflated_radius = hn::Add(same(sphere.radius), radius);
  return {hn::Sub(length, inflated_radius), over(out, length), hn::Div(same(1.0), inflated_radius)};
}
HWY_INLINE LaneGap lane_gap(const Plane& plane, Lane radius, const LaneVec3& x) {
  const LaneVec3 normal = same(plane.normal);
  return {hn::Sub(dot_of(normal, difference(x, same(plane.point))), radius), normal, same(0.0)};
}

// Points during a step.
struct Step {
  double h;
  Lane radius;
  LaneVec3 x0, v0, x1, v1;  // at its start, and at its end without contact
  LaneVec3 a;               // its mean acceleration
  Lane size_of_a;
};

struct Corrected {
  LaneVec3 x, v;
  LaneMask is_solved, is_unfinished;  // the latter: more segments are needed
  Lane gained;                        // [m^2/s^2], kinetic energy per mass along the path
};
HWY_INLINE Lane gain_of(const LaneVec3& end, const LaneVec3& start) {
  return hn::Mul(same(0.5), hn::Sub(dot_of(end, end), dot_of(start, start)));
}

// The normal force over mass, and the acceleration under it; `holds`: the support is loaded, and the point does not move into it.
struct Load {
  Lane normal_acceleration;
  LaneVec3 constrained;
  LaneMask holds;
};
HWY_INLINE Load load_of(const LaneGap& gap, const LaneVec3& a, Lane size_of_a, const LaneVec3& v) {
  const Lane centripetal = hn::Mul(gap.curvature, dot_of(v, v)), min = hn::Neg(hn::Mul(same(1e-12), size_of_a));
  const Lane separation = hn::Add(dot_of(gap.normal, a), centripetal), normal_acceleration = hn::Neg(separation);
  const LaneVec3 constrained = sum(a, times(normal_acceleration, gap.normal));
  const LaneMask is_feasible = hn::Ge(hn::Add(dot_of(gap.normal, constrained), centripetal), min);
  return {normal_acceleration, constrained, hn::And(hn::And(hn::Lt(separation, min), hn::Gt(normal_acceleration, same(0.0))), is_feasible)};
}

// The acceleration along the surface without friction.
template <class Shape>
HWY_INLINE LaneVec3 drive_of(const LaneGap& gap, const Load& load) {
  return std::is_same_v<Shape, Sphere> ? tangential_to(gap.normal, load.constrained) : load.constrained;
}
// Friction against it, as in plan_segment.
struct Hold {
  Lane required, max;
  LaneMask is_still, sticks;
};
HWY_INLINE Hold hold_of(double friction, const LaneVec3& drive, const Load& load, const Step& step, const LaneVec3& x, Lane speed,
                        Lane remaining) {
  Hold hold{length_of(drive), hn::Mul(same(friction), load.normal_acceleration), {}, {}};
  const Lane margin = hn::Sub(hold.max, hold.required);
  const LaneMask is_about_to_stop =
      hn::And(hn::Le(speed, hn::Mul(margin, remaining)), hn::Le(hn::Mul(speed, speed), hn::Mul(margin, tolerance_at(x))));
  hold.is_still = hn::Or(hn::Le(speed, same(0.0)), is_about_to_stop);
  hold.sticks = hn::And(hold.is_still, hn::Le(hold.required, hn::Add(hold.max, hn::Mul(same(1e-12), step.size_of_a))));
  return hold;
}

// The lanes of PointContactSolver::Segment, and the point at its end.
struct LaneSegment {
  LaneVec3 x, v;
  Lane time;
  LaneMask is_solved, has_moved;
};

// plan_segment, advance_segment and what follows it, from x with the velocity v on the surface, of the lanes `is_left`.
template <class Shape>
HWY_INLINE LaneSegment advance_on(const Shape& shape, double friction, const Step& step, const LaneGap& gap, const Load& load,
                                  const LaneVec3& start, LaneVec3 start_v, Lane remaining, LaneMask is_left,
                                  LaneVec3& velocity_correction) {
  constexpr bool is_curved = std::is_same_v<Shape, Sphere>;
  const Lane zero = same(0.0), mu = same(friction);
  const LaneVec3 none{zero, zero, zero}, &a = step.a;

  // sticks, starts to slide, or slides
  const PointLanes d;
  const LaneVec3 drive = drive_of<Shape>(gap, load);
  Lane speed = length_of(start_v);
  const auto [required, max_friction, is_still, sticks] = hold_of(friction, drive, load, step, start, speed, remaining);
  if (hn::AllFalse(d, hn::AndNot(sticks, is_left))) return {sum(start, none), none, remaining, load.holds, same_if(false)};
  const LaneMask starts = hn::And(is_left, hn::AndNot(sticks, is_still));
  start_v = choose(sticks, none, start_v);
  speed = hn::IfThenZeroElse(sticks, speed);
  LaneVec3 starting = none, sliding = drive;
  if (!hn::AllFalse(d, starts)) {
    const Lane part = hn::Sub(same(1.0), hn::Div(max_friction, required));
    starting = choose(starts, sum(none, times(part, drive)), none);
  }
  LaneSegment segment{start, start_v, remaining, load.holds, {}};
  LaneMask stops = same_if(false);
  if (!hn::AllFalse(d, hn::AndNot(is_still, is_left))) {
    sliding = difference(drive, times(hn::Div(max_friction, speed), start_v));
    const Lane deceleration = hn::Div(hn::Neg(dot_of(sliding, start_v)), speed);
    stops = hn::And(is_left, hn::AndNot(is_still, hn::Ge(hn::Mul(deceleration, remaining), speed)));
    if (!hn::AllFalse(d, stops)) segment.time = hn::IfThenElse(stops, hn::Div(speed, deceleration), remaining);
  }
  const LaneVec3 acceleration = sum(choose(is_still, starting, sliding), none);
  if constexpr (is_curved) {
    const Lane path = hn::Add(speed, hn::Mul(remaining, length_of(acceleration)));
    segment.is_solved = hn::And(segment.is_solved, hn::Le(hn::Mul(hn::Mul(gap.curvature, segment.time), path), same(0.125)));
    const Lane falls = hn::Mul(gap.curvature, hn::Add(dot_of(start_v, a), hn::Mul(same(2.0), dot_of(start_v, acceleration))));
    segment.is_solved = hn::And(segment.is_solved, hn::Le(hn::Mul(falls, segment.time), load.normal_acceleration));
  }

  const Lane half_time = hn::Mul(same(0.5), segment.time);
  LaneVec3 x = sum(start, times(segment.time, sum(start_v, times(half_time, acceleration))));
  LaneVec3 v = sum(start_v, times(segment.time, acceleration));
  const LaneMask is_at_start = equal(x, start);
  segment.has_moved = hn::Not(is_at_start);
  segment.x = x;
  segment.v = v;
  if (hn::AllFalse(d, hn::And(is_left, hn::And(segment.has_moved, segment.is_solved)))) return segment;

  // down from the tangent plane to the surface, unless it stopped
  LaneMask is_at_rest = stops;
  if (!hn::AllFalse(d, stops)) is_at_rest = hn::And(stops, hn::Le(length_of(v), hn::Mul(same(1e-9), speed)));
  if constexpr (is_curved) {
    const LaneVec3 displacement = difference(x, start);
    const Lane radius = hn::Div(same(1.0), gap.curvature), square = dot_of(displacement, displacement);
    const Lane fall = hn::Div(hn::Neg(square), hn::Add(radius, hn::Sqrt(hn::Sub(hn::Mul(radius, radius), square))));
    const LaneVec3 normal = sum(gap.normal, over(sum(displacement, times(fall, gap.normal)), radius));
    const Lane along_normal = hn::Add(hn::Div(fall, segment.time), hn::Mul(half_time, dot_of(a, gap.normal)));
    const LaneVec3 velocity = tangential_to(normal, sum(v, times(along_normal, gap.normal)));
    const Lane slip = length_of(velocity);
    const Lane at_end = hn::Sub(hn::Neg(dot_of(a, normal)), hn::Mul(gap.curvature, dot_of(velocity, velocity)));
    const Lane end_load = hn::IfThenElse(hn::Lt(zero, at_end), at_end, zero);
    const Lane loss = hn::Mul(hn::Mul(half_time, mu), hn::Sub(end_load, load.normal_acceleration));
    const Lane rest = hn::Sub(same(1.0), hn::Div(loss, slip));
    const LaneVec3 slowed = times(hn::IfThenElse(hn::Lt(zero, rest), rest, zero), velocity);
    const LaneVec3 followed = sum(none, choose(hn::Gt(slip, zero), slowed, velocity));
    x = choose(is_at_rest, x, sum(x, times(fall, gap.normal)));
    v = choose(is_at_rest, v, followed);
  }
  v = choose(is_at_rest, none, v);
  velocity_correction = choose(hn::AndNot(is_at_start, is_at_rest), none, velocity_correction);

  // round-off
  const LaneGap left = lane_gap(shape, step.radius, x);
  const LaneMask is_near = hn::And(hn::Le(hn::Abs(left.distance), tolerance_at(x)), hn::Ge(dot_of(left.normal, gap.normal), same(0.9)));
  segment.is_solved = hn::And(segment.is_solved, hn::Or(is_at_start, hn::Le(left.distance, tolerance_at(x))));
  x = choose(is_near, difference(x, times(left.distance, left.normal)), x);
  v = choose(is_near, difference(v, times(dot_of(v, left.normal), left.normal)), v);
  const LaneVec3 turned = difference(velocity_correction, times(dot_of(velocity_correction, left.normal), left.normal));
  velocity_correction = choose(hn::AndNot(is_at_start, is_near), turned, velocity_correction);
  segment.x = choose(is_at_start, segment.x, x);
  segment.v = choose(is_at_start, segment.v, v);
  return segment;
}

// PointContactSolver::advance on `shape` at rest, at the start of the step with `gap` to it. Under friction a path ends and goes on where
// the point stops.
template <class Shape>
HWY_INLINE Corrected slide(const Shape& shape, double friction, const Step& step, LaneGap gap, int max_segments) {
  const PointLanes d;
  const Lane zero = same(0.0), h = same(step.h);
  const LaneVec3 none{zero, zero, zero}, &a = step.a;
  const auto is_along = [&](const LaneVec3& normal, const LaneVec3& velocity, Lane duration) HWY_ATTR {
    const Lane max = hn::Mul(same(1e-12), hn::Add(length_of(velocity), hn::Mul(duration, step.size_of_a)));
    return hn::Le(hn::Abs(dot_of(velocity, normal)), max);
  };

  // on the surface, and moving neither into it nor away from it
  LaneVec3 x = step.x0, v = friction == 0.0 ? step.v0 : sum(step.v0, none);
  LaneMask is_solved = hn::Le(hn::Abs(gap.distance), tolerance_at(x));
  if (hn::AllFalse(d, is_solved)) return {x, v, is_solved, is_solved, zero};
  Load load = load_of(gap, a, step.size_of_a, v);
  is_solved = hn::And(is_solved, hn::And(is_along(gap.normal, v, h), load.holds));
  if (hn::AllFalse(d, is_solved)) return {x, v, is_solved, is_solved, zero};

  // without friction, a point that slides starts with the velocity of the method's path
  LaneVec3 velocity_correction = none;
  if (friction == 0.0) {
    const LaneVec3 of_method = difference(difference(over(difference(step.x1, x), h), v), times(same(0.5 * step.h), a));
    const LaneVec3 along = difference(of_method, times(dot_of(of_method, gap.normal), gap.normal));
    velocity_correction = choose(equal(v, none), none, along);
    v = sum(v, velocity_correction);
    load = load_of(gap, a, step.size_of_a, v);
    is_solved = hn::And(is_solved, is_along(gap.normal, v, h));
  }

  const LaneVec3 start = v;
  Lane remaining = h;
  LaneMask is_left = is_solved, has_moved = same_if(false);
  for (int segments = 0; segments < max_segments && !hn::AllFalse(d, is_left); ++segments) {
    if (segments > 0) {
      gap = lane_gap(shape, step.radius, x);
      load = load_of(gap, a, step.size_of_a, v);
      const LaneMask is_supported = hn::And(hn::Le(gap.distance, tolerance_at(x)), is_along(gap.normal, v, remaining));
      is_solved = hn::And(is_solved, hn::Or(is_supported, hn::Not(is_left)));
    }
    LaneVec3 correction = velocity_correction;
    const LaneSegment segment = advance_on(shape, friction, step, gap, load, x, v, remaining, is_left, correction);
    is_solved = hn::And(is_solved, hn::Or(segment.is_solved, hn::Not(is_left)));
    is_left = hn::And(is_left, is_solved);
    x = choose(is_left, segment.x, x);
    v = choose(is_left, segment.v, v);
    velocity_correction = choose(is_left, correction, velocity_correction);
    has_moved = hn::Or(has_moved, hn::And(is_left, segment.has_moved));
    remaining = hn::IfThenElse(is_left, hn::Sub(remaining, segment.time), remaining);
    is_left = hn::And(is_left, hn::Gt(remaining, zero));
  }
  if (!hn::AllFalse(d, has_moved))
    is_solved = hn::And(is_solved, hn::Ge(lane_gap(shape, step.radius, x).distance, hn::Neg(tolerance_at(x))));
  return {x, difference(v, velocity_correction), is_solved, hn::And(is_solved, is_left), gain_of(v, start)};
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
