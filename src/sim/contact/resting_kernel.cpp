// The operations of point_contact.cpp on vectors of points, on one path through it: no obstacle is penetrated, and one support is loaded
// for the whole step. Compiled once for each vector unit by Highway, which picks one at run time; the same IEEE operations in the same
// order as there, in every width.
#include "sim/contact/resting_kernel.h"

#include <type_traits>
#include <variant>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/contact/resting_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

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
  LaneMask is_solved;
  Lane gained;  // [m^2/s^2], kinetic energy per mass along the path
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

// Friction against the acceleration `drive` along the surface, as in PointContactSolver::plan_segment.
struct Hold {
  Lane required, max;
  LaneMask is_still, sticks;
};
HWY_INLINE Hold hold_of(double friction, const LaneVec3& drive, const Load& load, const Step& step, Lane speed) {
  Hold hold{length_of(drive), hn::Mul(same(friction), load.normal_acceleration), {}, {}};
  const Lane margin = hn::Sub(hold.max, hold.required);
  const LaneMask is_about_to_stop =
      hn::And(hn::Le(speed, hn::Mul(margin, same(step.h))), hn::Le(hn::Mul(speed, speed), hn::Mul(margin, tolerance_at(step.x0))));
  hold.is_still = hn::Or(hn::Le(speed, same(0.0)), is_about_to_stop);
  hold.sticks = hn::And(hold.is_still, hn::Le(hold.required, hn::Add(hold.max, hn::Mul(same(1e-12), step.size_of_a))));
  return hold;
}

// PointContactSolver::follow_surface, from the tangent plane down to the ball.
HWY_INLINE void follow_ball(const LaneGap& gap, const Load& load, double friction, const Step& step, LaneVec3& x, LaneVec3& v) {
  const Lane zero = same(0.0), half_time = hn::Mul(same(0.5), same(step.h)), radius = hn::Div(same(1.0), gap.curvature);
  const LaneVec3 displacement = difference(x, step.x0);
  const Lane square = dot_of(displacement, displacement);
  const Lane fall = hn::Div(hn::Neg(square), hn::Add(radius, hn::Sqrt(hn::Sub(hn::Mul(radius, radius), square))));
  const LaneVec3 normal = sum(gap.normal, over(sum(displacement, times(fall, gap.normal)), radius));
  const Lane along_normal = hn::Add(hn::Div(fall, same(step.h)), hn::Mul(half_time, dot_of(step.a, gap.normal)));
  const LaneVec3 velocity = tangential_to(normal, sum(v, times(along_normal, gap.normal)));
  const Lane slip = length_of(velocity);
  const Lane at_end = hn::Sub(hn::Neg(dot_of(step.a, normal)), hn::Mul(gap.curvature, dot_of(velocity, velocity)));
  const Lane end_load = hn::IfThenElse(hn::Lt(zero, at_end), at_end, zero);
  const Lane loss = hn::Mul(hn::Mul(half_time, same(friction)), hn::Sub(end_load, load.normal_acceleration));
  const Lane rest = hn::Sub(same(1.0), hn::Div(loss, slip));
  const LaneVec3 slowed = times(hn::IfThenElse(hn::Lt(zero, rest), rest, zero), velocity);
  x = sum(x, times(fall, gap.normal));
  v = sum(LaneVec3{zero, zero, zero}, choose(hn::Gt(slip, zero), slowed, velocity));
}

// PointContactSolver::advance on `shape` at rest, of points that stick to it or slide along it for the whole step.
template <class Shape>
HWY_INLINE Corrected slide(const Shape& shape, double friction, const Step& step) {
  constexpr bool is_curved = std::is_same_v<Shape, Sphere>;
  const PointLanes d;
  const Lane zero = same(0.0), h = same(step.h);
  const LaneVec3 none{zero, zero, zero}, &a = step.a;
  const auto is_along = [&](const LaneVec3& normal, const LaneVec3& velocity) HWY_ATTR {
    const Lane max = hn::Mul(same(1e-12), hn::Add(length_of(velocity), hn::Mul(h, step.size_of_a)));
    return hn::Le(hn::Abs(dot_of(velocity, normal)), max);
  };

  // on the surface, and moving neither into it nor away from it
  const LaneGap gap = lane_gap(shape, step.radius, step.x0);
  LaneVec3 v = friction == 0.0 ? step.v0 : sum(step.v0, none);
  LaneMask is_solved = hn::Le(hn::Abs(gap.distance), tolerance_at(step.x0));
  if (hn::AllFalse(d, is_solved)) return {step.x0, v, is_solved, zero};
  Load load = load_of(gap, a, step.size_of_a, v);
  is_solved = hn::And(is_solved, hn::And(is_along(gap.normal, v), load.holds));
  if (hn::AllFalse(d, is_solved)) return {step.x0, v, is_solved, zero};

  // without friction, a point that slides starts with the velocity of the method's path
  LaneVec3 velocity_correction = none;
  if (friction == 0.0) {
    const LaneVec3 of_method = difference(difference(over(difference(step.x1, step.x0), h), v), times(same(0.5 * step.h), a));
    const LaneVec3 along = difference(of_method, times(dot_of(of_method, gap.normal), gap.normal));
    velocity_correction = choose(equal(v, none), none, along);
    v = sum(v, velocity_correction);
    load = load_of(gap, a, step.size_of_a, v);
    is_solved = hn::And(is_solved, hn::And(is_along(gap.normal, v), load.holds));
  }

  // sticks, starts to slide, or slides without an end
  const LaneVec3 start = v, drive = is_curved ? tangential_to(gap.normal, load.constrained) : load.constrained;
  const Lane speed = length_of(v);
  const auto [required, max_friction, is_still, sticks] = hold_of(friction, drive, load, step, speed);
  v = choose(sticks, none, v);
  if (hn::AllFalse(d, hn::AndNot(sticks, is_solved)))
    return {sum(step.x0, none), difference(v, velocity_correction), is_solved, gain_of(v, start)};
  const LaneVec3 starting = choose(sticks, none, sum(none, times(hn::Sub(same(1.0), hn::Div(max_friction, required)), drive)));
  const LaneVec3 sliding = difference(drive, times(hn::Div(max_friction, speed), v));
  const Lane deceleration = hn::Div(hn::Neg(dot_of(sliding, v)), speed);
  is_solved = hn::And(is_solved, hn::Or(is_still, hn::Not(hn::Ge(hn::Mul(deceleration, h), speed))));
  const LaneVec3 acceleration = sum(choose(is_still, starting, sliding), none);
  if constexpr (is_curved) {
    const Lane path = hn::Add(hn::IfThenZeroElse(sticks, speed), hn::Mul(h, length_of(acceleration)));
    const Lane falls = hn::Mul(gap.curvature, hn::Add(dot_of(v, a), hn::Mul(same(2.0), dot_of(v, acceleration))));
    is_solved = hn::And(is_solved, hn::And(hn::Le(hn::Mul(hn::Mul(gap.curvature, h), path), same(0.125)),
                                           hn::Le(hn::Mul(falls, h), load.normal_acceleration)));
  }
  LaneVec3 x = sum(step.x0, times(h, sum(v, times(hn::Mul(same(0.5), h), acceleration))));
  v = sum(v, times(h, acceleration));
  const LaneMask has_moved = hn::Not(equal(x, step.x0));
  LaneVec3 end_x = x, end_v = v;
  if constexpr (is_curved) follow_ball(gap, load, friction, step, end_x, end_v);

  // round-off
  const LaneGap left = lane_gap(shape, step.radius, end_x);
  const LaneMask is_near = hn::And(hn::Le(hn::Abs(left.distance), tolerance_at(end_x)), hn::Ge(dot_of(left.normal, gap.normal), same(0.9)));
  is_solved = hn::And(is_solved, hn::Or(hn::Not(has_moved), hn::Le(left.distance, tolerance_at(end_x))));
  end_x = choose(is_near, difference(end_x, times(left.distance, left.normal)), end_x);
  end_v = choose(is_near, difference(end_v, times(dot_of(end_v, left.normal), left.normal)), end_v);
  const LaneVec3 turned = difference(velocity_correction, times(dot_of(velocity_correction, left.normal), left.normal));
  velocity_correction = choose(hn::And(has_moved, is_near), turned, velocity_correction);
  x = choose(has_moved, end_x, x);
  v = choose(has_moved, end_v, v);
  const LaneMask is_outside = hn::Ge(lane_gap(shape, step.radius, x).distance, hn::Neg(tolerance_at(x)));
  is_solved = hn::And(is_solved, hn::Or(is_outside, hn::Not(has_moved)));
  return {x, difference(v, velocity_correction), is_solved, gain_of(v, start)};
}

// [m], of the coordinates of a shape: round-off is a small part of it.
HWY_INLINE double size_of(double number) { return number < 0.0 ? -number : number; }
HWY_INLINE double extent_of(const Vec3& a) { return size_of(a.x) + size_of(a.y) + size_of(a.z); }
HWY_INLINE double extent_of(const Sphere& sphere) { return extent_of(sphere.center) + sphere.radius; }
HWY_INLINE double extent_of(const Plane& plane) { return extent_of(plane.point); }

// The gap at the start of the step, and along the normal there the displacement and h times the acceleration.
struct Approach {
  Lane gap, displacement, velocity_change;
};
HWY_INLINE Approach approach_to(const Sphere& sphere, const Step& step) {
  const LaneVec3 out = difference(step.x0, same(sphere.center));
  const Lane length = length_of(out), along = hn::Div(same(1.0), length);
  return {hn::Sub(length, hn::Add(same(sphere.radius), step.radius)), hn::Mul(along, dot_of(out, difference(step.x1, step.x0))),
          hn::Mul(along, dot_of(out, difference(step.v1, step.v0)))};
}
HWY_INLINE Approach approach_to(const Plane& plane, const Step& step) {
  const LaneVec3 normal = same(plane.normal);
  return {hn::Sub(dot_of(normal, difference(step.x0, same(plane.point))), step.radius), dot_of(normal, difference(step.x1, step.x0)),
          dot_of(normal, difference(step.v1, step.v0))};
}

// Whether points in flight certainly stay clear of the shape, which lies behind the tangent plane below their start: their path deviates
// from the straight line by at most an eighth of h times the change of their velocity.
template <class Shape>
HWY_INLINE LaneMask stay_clear(const Shape& shape, const Step& step) {
  const auto [gap, displacement, velocity_change] = approach_to(shape, step);
  const Lane bulge = hn::Mul(same(0.125 * step.h), hn::Abs(velocity_change));
  const Lane margin = hn::Mul(same(1e-12), hn::Add(magnitude(step.x0), same(extent_of(shape))));
  return hn::Gt(hn::Sub(hn::Add(gap, hn::Min(displacement, same(0.0))), bulge), margin);
}
HWY_INLINE LaneMask stay_clear(const ColliderShape& any_shape, const Step& step) {
  if (const auto* sphere = std::get_if<Sphere>(&any_shape)) return stay_clear(*sphere, step);
  if (const auto* plane = std::get_if<Plane>(&any_shape)) return stay_clear(*plane, step);
  return same_if(false);
}

// The mean acceleration.
HWY_INLINE void set_acceleration(Step& step) {
  step.a = over(difference(step.v1, step.v0), same(step.h));
  step.size_of_a = length_of(step.a);
}

// Whether points may come within `reach` of the shape. Also if a number is not one.
HWY_INLINE LaneMask may_reach(const Sphere& sphere, Lane reach, const LaneVec3& x) {
  const LaneVec3 out = difference(x, same(sphere.center));
  const Lane limit = hn::Add(same(sphere.radius), reach);
  return hn::Not(hn::Gt(dot_of(out, out), hn::Mul(limit, limit)));
}
HWY_INLINE LaneMask may_reach(const Plane& plane, Lane reach, const LaneVec3& x) {
  return hn::Not(hn::Gt(dot_of(same(plane.normal), difference(x, same(plane.point))), reach));
}
HWY_INLINE LaneMask may_reach(const Box& box, Lane reach, const LaneVec3& x) {
  const auto is_between = [&](Lane at, double min, double max) HWY_ATTR {
    return hn::Not(hn::Or(hn::Lt(at, hn::Sub(same(min), reach)), hn::Gt(at, hn::Add(same(max), reach))));
  };
  return hn::And(hn::And(is_between(x.x, box.min.x, box.max.x), is_between(x.y, box.min.y, box.max.y)),
                 is_between(x.z, box.min.z, box.max.z));
}

// The same for any shape, with a margin for round-off, which is a small part of the coordinates.
HWY_INLINE LaneMask may_reach(const ColliderShape& any_shape, Lane reach, const LaneVec3& x) {
  const auto extended = [&](double extent) HWY_ATTR { return hn::Add(reach, hn::Mul(same(1e-12), hn::Add(magnitude(x), same(extent)))); };
  if (const auto* sphere = std::get_if<Sphere>(&any_shape)) return may_reach(*sphere, extended(extent_of(*sphere)), x);
  if (const auto* plane = std::get_if<Plane>(&any_shape)) return may_reach(*plane, extended(extent_of(*plane)), x);
  return may_reach(*std::get_if<Box>(&any_shape), extended(0.0), x);
}

HWY_INLINE LaneVec3 load_point(const Plan& plan, const double* field, std::size_t i) {
  const PointLanes d;
  const std::size_t n = static_cast<std::size_t>(plan.points);
  return {hn::LoadU(d, field + i), hn::LoadU(d, field + n + i), plan.dimensions == 3 ? hn::LoadU(d, field + 2 * n + i) : hn::Zero(d)};
}
HWY_INLINE void store_point(const Plan& plan, const LaneVec3& value, LaneMask mask, double* field, std::size_t i) {
  const PointLanes d;
  const std::size_t n = static_cast<std::size_t>(plan.points);
  hn::BlendedStore(value.x, mask, d, field + i);
  hn::BlendedStore(value.y, mask, d, field + n + i);
  if (plan.dimensions == 3) hn::BlendedStore(value.z, mask, d, field + 2 * n + i);
}

HWY_INLINE Lane work_per_mass(const Step& step, const Corrected& corrected) {
  return hn::Sub(corrected.gained, dot_of(step.a, difference(corrected.x, step.x0)));
}

// One per lane, from the lowest bit up.
HWY_INLINE unsigned bits_of(LaneMask mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(PointLanes(), mask, bits);
  return bits[0];
}

// Of the points of a vector, those that are `open` if they touch, and of these the `solved` ones.
HWY_INLINE void set_outcomes(unsigned open, unsigned solved, RestingPoints& points, RestingPoints::Outcome* outcome) {
  points.any_solved = points.any_solved || solved != 0;
  points.any_open = points.any_open || (open & ~solved) != 0;
  for (std::size_t lane = 0; lane < hn::Lanes(PointLanes()); ++lane)
    if ((open >> lane & 1U) != 0) outcome[lane] = (solved >> lane & 1U) != 0 ? RestingPoints::Solved : RestingPoints::Open;
}

// Of the lanes `near` the collider: those that may touch it are `open`. Those near no other are corrected and `solved`, if they can be.
HWY_INLINE void solve_on(const Plan& plan, const Collider& collider, Step& step, LaneMask near, LaneMask several, std::size_t i, double* x,
                         double* v, Lane& work, LaneMask& open, LaneMask& solved) {
  const PointLanes d;
  const LaneMask touching = hn::AndNot(stay_clear(collider.shape, step), near), alone = hn::AndNot(several, touching);
  open = hn::Or(open, touching);
  if (hn::AllFalse(d, alone)) return;
  const auto solve = [&](const auto& shape) HWY_ATTR {
    set_acceleration(step);
    const Corrected corrected = slide(shape, collider.friction, step);
    const LaneMask here = hn::And(alone, corrected.is_solved);
    store_point(plan, corrected.x, here, x, i);
    store_point(plan, corrected.v, here, v, i);
    work = hn::IfThenElse(here, hn::Mul(hn::LoadU(d, plan.mass.data() + i), work_per_mass(step, corrected)), work);
    solved = hn::Or(solved, here);
  };
  if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) solve(*sphere);
  if (const auto* plane = std::get_if<Plane>(&collider.shape)) solve(*plane);
}

void solve_resting(const Plan& plan, double h, std::size_t first, std::size_t end, const double* x0, const double* v0, double* x, double* v,
                   RestingPoints& points) {
  const PointLanes d;
  const std::size_t lanes = hn::Lanes(d);
  points.any_solved = points.any_open = false;
  std::size_t i = first;
  for (; i + lanes <= end; i += lanes) {
    Step step;  // without its acceleration, which few points need
    step.h = h;
    step.radius = hn::LoadU(d, plan.radius.data() + i);
    step.x0 = load_point(plan, x0, i), step.v0 = load_point(plan, v0, i);
    step.x1 = load_point(plan, x, i), step.v1 = load_point(plan, v, i);

    // A path under any contact with one collider is shorter than 1.5 h (|v0| + |correction|) + h^2 |a|, with
    // h |correction| <= |x1 - x0| + h (|v0| + |v1|) / 2 and h |a| <= |v0| + |v1|: by far than this.
    const Lane one = same(1.0);
    const Lane speeds = hn::Sub(hn::Add(magnitude(step.v0), magnitude(step.v1)), same(2.0));
    const Lane path = hn::Add(hn::Sub(magnitude(difference(step.x1, step.x0)), one), hn::Mul(same(h), speeds));
    const Lane reach = hn::Add(step.radius, hn::Mul(same(4.0), path));
    LaneMask any = same_if(false), several = any, open = any, solved = any;
    for (const Collider& collider : plan.colliders) {
      const LaneMask near = may_reach(collider.shape, reach, step.x0);
      several = hn::Or(several, hn::And(any, near));
      any = hn::Or(any, near);
    }
    any = hn::And(any, hn::Ne(hn::LoadU(d, plan.inverse_mass.data() + i), same(0.0)));
    RestingPoints::Outcome* const outcome = points.outcome + (i - first);
    for (std::size_t lane = 0; lane < lanes; ++lane) outcome[lane] = RestingPoints::Free;
    Lane work = same(0.0);
    if (!hn::AllFalse(d, any)) {
      for (const Collider& collider : plan.colliders)
        solve_on(plan, collider, step, hn::And(any, may_reach(collider.shape, reach, step.x0)), several, i, x, v, work, open, solved);
      if (!hn::AllFalse(d, open)) set_outcomes(bits_of(open), bits_of(solved), points, outcome);
    }
    hn::StoreU(work, d, points.work + (i - first));
  }
  for (; i < end; ++i) {
    points.outcome[i - first] = RestingPoints::Open;
    points.work[i - first] = 0.0;
    points.any_open = true;
  }
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(solve_resting);

void solve_resting_points(const Plan& plan, double h, std::size_t first, std::size_t end, const Field& x0, const Field& v0, Field& x,
                          Field& v, RestingPoints& points) {
  HWY_DYNAMIC_DISPATCH(solve_resting)
  (plan, h, first, end, x0.data(), v0.data(), x.data(), v.data(), points);
}

}  // namespace hooke
#endif
