// The operations of point_contact.cpp, on one path through it: no obstacle is penetrated, one support is loaded, and some segments take
// the whole step. A point whose path branches off anywhere stays open. Compiled once for each vector unit by Highway, which picks one
// at run time; the same IEEE operations in the same order as there.
#include "sim/contact/resting_kernel.h"

#include <array>
#include <type_traits>
#include <variant>

#include "sim/contact/point_contact.h"

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
  LaneMask is_solved, is_unfinished;  // the latter: more segments are needed
};

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

// The lanes of PointContactSolver::Segment, and the point at its end.
struct LaneSegment {
  LaneVec3 x, v;
  Lane time;
  LaneMask is_solved, has_moved;
};

// plan_segment, advance_segment and what follows it, from x with the velocity v on the surface.
template <class Shape>
HWY_INLINE LaneSegment advance_on(const Shape& shape, double friction, const Step& step, const LaneGap& gap, const Load& load,
                                  const LaneVec3& start, const LaneVec3& start_v, Lane remaining, LaneVec3& velocity_correction) {
  constexpr bool is_curved = std::is_same_v<Shape, Sphere>;
  const Lane zero = same(0.0), mu = same(friction);
  const LaneVec3 none{zero, zero, zero}, &a = step.a;

  // sticks, starts to slide, or slides
  const Lane max_friction = hn::Mul(mu, load.normal_acceleration), speed = length_of(start_v);
  const LaneVec3 drive = is_curved ? tangential_to(gap.normal, load.constrained) : load.constrained;
  const Lane required = length_of(drive);
  const LaneMask is_still = hn::Le(speed, zero);
  const LaneMask sticks = hn::And(is_still, hn::Le(required, hn::Add(max_friction, hn::Mul(same(1e-12), step.size_of_a))));
  const LaneVec3 starting = choose(sticks, none, sum(none, times(hn::Sub(same(1.0), hn::Div(max_friction, required)), drive)));
  const LaneVec3 sliding = difference(drive, times(hn::Div(max_friction, speed), start_v));
  const Lane deceleration = hn::Div(hn::Neg(dot_of(sliding, start_v)), speed);
  LaneSegment segment{start, start_v, remaining, load.holds, {}};
  const LaneMask stops = hn::AndNot(is_still, hn::Ge(hn::Mul(deceleration, remaining), speed));
  segment.time = hn::IfThenElse(stops, hn::Div(speed, deceleration), remaining);
  const LaneVec3 acceleration = sum(choose(is_still, starting, sliding), none);
  if constexpr (is_curved) {
    const Lane path = hn::Add(speed, hn::Mul(remaining, length_of(acceleration)));
    segment.is_solved = hn::And(segment.is_solved, hn::Le(hn::Mul(hn::Mul(gap.curvature, segment.time), path), same(0.125)));
  }

  const Lane half_time = hn::Mul(same(0.5), segment.time);
  LaneVec3 x = sum(start, times(segment.time, sum(start_v, times(half_time, acceleration))));
  LaneVec3 v = sum(start_v, times(segment.time, acceleration));
  const LaneMask is_at_start = equal(x, start);
  segment.has_moved = hn::Not(is_at_start);
  segment.x = x;
  segment.v = v;
  if (hn::AllFalse(PointLanes(), hn::And(segment.has_moved, segment.is_solved))) return segment;

  // down from the tangent plane to the surface, unless it stopped
  const LaneMask is_at_rest = hn::And(stops, hn::Le(length_of(v), hn::Mul(same(1e-9), speed)));
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
  x = choose(is_near, difference(x, times(left.distance, left.normal)), x);
  v = choose(is_near, difference(v, times(dot_of(v, left.normal), left.normal)), v);
  const LaneVec3 turned = difference(velocity_correction, times(dot_of(velocity_correction, left.normal), left.normal));
  velocity_correction = choose(hn::AndNot(is_at_start, is_near), turned, velocity_correction);
  segment.x = choose(is_at_start, segment.x, x);
  segment.v = choose(is_at_start, segment.v, v);
  return segment;
}

// PointContactSolver::advance on `shape` at rest. Under friction a path ends and goes on where the point stops.
template <class Shape>
HWY_INLINE Corrected slide(const Shape& shape, double friction, const Step& step, int max_segments) {
  const PointLanes d;
  const Lane zero = same(0.0), h = same(step.h);
  const LaneVec3 none{zero, zero, zero}, &a = step.a;
  const auto is_along = [&](const LaneVec3& normal, const LaneVec3& velocity, Lane duration) HWY_ATTR {
    const Lane max = hn::Mul(same(1e-12), hn::Add(length_of(velocity), hn::Mul(duration, step.size_of_a)));
    return hn::Le(hn::Abs(dot_of(velocity, normal)), max);
  };

  // on the surface, and moving neither into it nor away from it
  LaneVec3 x = step.x0, v = step.v0;
  LaneGap gap = lane_gap(shape, step.radius, x);
  Load load = load_of(gap, a, step.size_of_a, v);
  LaneMask is_solved = hn::And(is_along(gap.normal, v, h), load.holds);
  is_solved = hn::And(is_solved, hn::Le(hn::Abs(gap.distance), tolerance_at(x)));
  if (hn::AllFalse(d, is_solved)) return {x, v, is_solved, is_solved};

  // without friction, a point that slides starts with the velocity of the method's path
  LaneVec3 velocity_correction = none;
  if (friction == 0.0) {
    const LaneVec3 of_method = difference(difference(over(difference(step.x1, x), h), v), times(same(0.5 * step.h), a));
    const LaneVec3 along = difference(of_method, times(dot_of(of_method, gap.normal), gap.normal));
    velocity_correction = choose(equal(v, none), none, along);
    v = sum(v, velocity_correction);
    load = load_of(gap, a, step.size_of_a, v);
    is_solved = hn::And(is_solved, is_along(gap.normal, v, h));
  } else {
    v = sum(v, none);
  }

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
    const LaneSegment segment = advance_on(shape, friction, step, gap, load, x, v, remaining, correction);
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
  return {x, difference(v, velocity_correction), is_solved, hn::And(is_solved, is_left)};
}

// [m], of the coordinates of a shape: round-off is a small part of it.
HWY_INLINE double size_of(double number) { return number < 0.0 ? -number : number; }
HWY_INLINE double extent_of(const Vec3& a) { return size_of(a.x) + size_of(a.y) + size_of(a.z); }
HWY_INLINE double extent_of(const Sphere& sphere) { return extent_of(sphere.center) + sphere.radius; }
HWY_INLINE double extent_of(const Plane& plane) { return extent_of(plane.point); }

// Whether points in flight certainly stay clear of the shape, which lies behind the tangent plane below their start: the minimum over the
// step of g + v t + a t^2 / 2, with g, v and a along the normal.
template <class Shape>
HWY_INLINE LaneMask stay_clear(const Shape& shape, double extent, const Step& step) {
  const Lane zero = same(0.0), h = same(step.h), half = same(0.5);
  const LaneGap gap = lane_gap(shape, step.radius, step.x0);
  const Lane displacement = dot_of(gap.normal, difference(step.x1, step.x0)), a = dot_of(gap.normal, step.a);
  const Lane v = hn::Sub(hn::Div(displacement, h), hn::Mul(half, hn::Mul(h, a)));
  const LaneMask turns = hn::And(hn::Lt(v, zero), hn::Lt(hn::Neg(v), hn::Mul(h, a)));
  const Lane at_turn = hn::IfThenElseZero(turns, hn::Neg(hn::Div(hn::Mul(half, hn::Mul(v, v)), a)));
  const Lane lowest = hn::Min(hn::Min(displacement, zero), at_turn);
  return hn::Gt(hn::Add(gap.distance, lowest), hn::Mul(same(1e-12), hn::Add(magnitude(step.x0), same(extent))));
}
HWY_INLINE LaneMask stay_clear(const ColliderShape& any_shape, const Step& step) {
  if (const auto* sphere = std::get_if<Sphere>(&any_shape)) return stay_clear(*sphere, extent_of(*sphere), step);
  if (const auto* plane = std::get_if<Plane>(&any_shape)) return stay_clear(*plane, extent_of(*plane), step);
  return same_if(false);
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
  const Lane gained = hn::Mul(same(0.5), hn::Sub(dot_of(corrected.v, corrected.v), dot_of(step.v1, step.v1)));
  return hn::Sub(gained, dot_of(step.a, difference(corrected.x, step.x1)));
}

// A point that stops under friction may take many segments: such points are solved again, together.
constexpr int first_segments = 2;
struct Unfinished {
  std::size_t count = 0;
  std::array<std::size_t, RestingPoints::max> point;
  std::array<const Collider*, RestingPoints::max> collider;
  void add(std::size_t i, const Collider& on) {
    point[count] = i;
    collider[count++] = &on;
  }
};

// Some points as the lanes of a vector; those after the last one repeat it.
struct Gathered {
  HWY_ALIGN double numbers[14][8];
  HWY_INLINE void set(std::size_t lane, const Plan& plan, std::size_t i, const double* const* fields) {
    const std::size_t n = static_cast<std::size_t>(plan.points);
    for (std::size_t field = 0; field < 4; ++field)
      for (std::size_t c = 0; c < 3; ++c)
        numbers[3 * field + c][lane] = c < static_cast<std::size_t>(plan.dimensions) ? fields[field][c * n + i] : 0.0;
    numbers[12][lane] = plan.radius[i];
    numbers[13][lane] = plan.mass[i];
  }
  HWY_INLINE LaneVec3 vectors(std::size_t field) const {
    const PointLanes d;
    return {hn::LoadU(d, numbers[3 * field]), hn::LoadU(d, numbers[3 * field + 1]), hn::LoadU(d, numbers[3 * field + 2])};
  }
};

void solve_unfinished(const Plan& plan, double h, std::size_t first, const Unfinished& unfinished, const double* x0, const double* v0,
                      double* x, double* v, RestingPoints& points) {
  const PointLanes d;
  const std::size_t n = static_cast<std::size_t>(plan.points), lanes = hn::Lanes(d);
  const double* const fields[] = {x0, v0, x, v};
  for (const Collider& collider : plan.colliders)
    for (std::size_t next = 0; next < unfinished.count;) {
      Gathered gathered;
      std::size_t point[8] = {}, count = 0;
      for (; next < unfinished.count && count < lanes; ++next) {
        if (unfinished.collider[next] != &collider) continue;
        point[count] = unfinished.point[next];
        gathered.set(count, plan, point[count], fields);
        ++count;
      }
      if (count == 0) break;
      for (std::size_t lane = count; lane < lanes; ++lane) gathered.set(lane, plan, point[count - 1], fields);

      Step step{
          h, hn::LoadU(d, gathered.numbers[12]), gathered.vectors(0), gathered.vectors(1), gathered.vectors(2), gathered.vectors(3), {},
          {}};
      step.a = over(difference(step.v1, step.v0), same(h));
      step.size_of_a = length_of(step.a);
      const auto* sphere = std::get_if<Sphere>(&collider.shape);
      const Corrected corrected = sphere != nullptr
                                      ? slide(*sphere, collider.friction, step, max_path_segments)
                                      : slide(*std::get_if<Plane>(&collider.shape), collider.friction, step, max_path_segments);
      double result[7][8];
      const Lane columns[] = {corrected.x.x,
                              corrected.x.y,
                              corrected.x.z,
                              corrected.v.x,
                              corrected.v.y,
                              corrected.v.z,
                              hn::Mul(hn::LoadU(d, gathered.numbers[13]), work_per_mass(step, corrected))};
      for (std::size_t column = 0; column < 7; ++column) hn::StoreU(columns[column], d, result[column]);
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, corrected.is_solved, bits);
      for (std::size_t lane = 0; lane < count; ++lane) {
        if ((bits[0] >> lane & 1U) == 0) continue;
        for (std::size_t c = 0; c < static_cast<std::size_t>(plan.dimensions); ++c) {
          x[c * n + point[lane]] = result[c][lane];
          v[c * n + point[lane]] = result[3 + c][lane];
        }
        points.work[point[lane] - first] = result[6][lane];
        points.outcome[point[lane] - first] = RestingPoints::Solved;
      }
    }
}

void solve_resting(const Plan& plan, double h, std::size_t first, const double* x0, const double* v0, double* x, double* v,
                   RestingPoints& points) {
  const PointLanes d;
  const std::size_t n = static_cast<std::size_t>(plan.points), lanes = hn::Lanes(d);
  const std::size_t end = first + RestingPoints::max < n ? first + RestingPoints::max : n;
  Unfinished unfinished;
  std::size_t i = first;
  for (; i + lanes <= end; i += lanes) {
    Step step{h,
              hn::LoadU(d, plan.radius.data() + i),
              load_point(plan, x0, i),
              load_point(plan, v0, i),
              load_point(plan, x, i),
              load_point(plan, v, i),
              {},
              {}};

    // A path under any contact with one collider is shorter than 1.5 h (|v0| + |correction|) + h^2 |a|, with
    // h |correction| <= |x1 - x0| + h (|v0| + |v1|) / 2 and h |a| <= |v0| + |v1|: by far than this.
    const Lane one = same(1.0);
    const Lane speeds = hn::Sub(hn::Add(magnitude(step.v0), magnitude(step.v1)), same(2.0));
    const Lane path = hn::Add(hn::Sub(magnitude(difference(step.x1, step.x0)), one), hn::Mul(same(h), speeds));
    const Lane reach = hn::Add(step.radius, hn::Mul(same(4.0), path));
    LaneMask any = same_if(false), several = any;
    for (const Collider& collider : plan.colliders) {
      const LaneMask near = may_reach(collider.shape, reach, step.x0);
      several = hn::Or(several, hn::And(any, near));
      any = hn::Or(any, near);
    }
    const LaneMask is_movable = hn::Ne(hn::LoadU(d, plan.inverse_mass.data() + i), same(0.0));
    any = hn::And(any, is_movable);
    for (std::size_t lane = 0; lane < lanes; ++lane) points.outcome[i - first + lane] = RestingPoints::Free;
    if (hn::AllFalse(d, any)) continue;

    step.a = over(difference(step.v1, step.v0), same(h));
    step.size_of_a = length_of(step.a);
    LaneMask is_open = same_if(false);
    for (const Collider& collider : plan.colliders)
      is_open = hn::Or(is_open, hn::AndNot(stay_clear(collider.shape, step), may_reach(collider.shape, reach, step.x0)));
    any = hn::And(any, is_open);
    if (hn::AllFalse(d, any)) continue;
    LaneMask solved = same_if(false);
    const LaneMask alone = hn::AndNot(several, any);
    if (!hn::AllFalse(d, alone))
      for (const Collider& collider : plan.colliders) {
        const auto solve_on = [&](const auto& shape) HWY_ATTR {
          const LaneMask near = hn::And(alone, may_reach(collider.shape, reach, step.x0));
          if (hn::AllFalse(d, near)) return;
          const Corrected corrected = slide(shape, collider.friction, step, first_segments);
          const LaneMask here = hn::And(near, hn::AndNot(corrected.is_unfinished, corrected.is_solved));
          store_point(plan, corrected.x, here, x, i);
          store_point(plan, corrected.v, here, v, i);
          const Lane work = hn::Mul(hn::LoadU(d, plan.mass.data() + i), work_per_mass(step, corrected));
          hn::BlendedStore(work, here, d, points.work.data() + (i - first));
          solved = hn::Or(solved, here);
          std::uint8_t bits[8] = {};
          hn::StoreMaskBits(d, hn::And(near, corrected.is_unfinished), bits);
          for (std::size_t lane = 0; lane < lanes; ++lane)
            if ((bits[0] >> lane & 1U) != 0) unfinished.add(i + lane, collider);
        };
        if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) solve_on(*sphere);
        if (const auto* plane = std::get_if<Plane>(&collider.shape)) solve_on(*plane);
      }
    std::uint8_t any_bits[8] = {}, solved_bits[8] = {};
    hn::StoreMaskBits(d, any, any_bits);
    hn::StoreMaskBits(d, solved, solved_bits);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if ((any_bits[0] >> lane & 1U) == 0) continue;
      points.outcome[i - first + lane] = (solved_bits[0] >> lane & 1U) != 0 ? RestingPoints::Solved : RestingPoints::Open;
    }
  }
  for (; i < end; ++i) points.outcome[i - first] = RestingPoints::Open;
  solve_unfinished(plan, h, first, unfinished, x0, v0, x, v, points);
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(solve_resting);

void solve_resting_points(const Plan& plan, double h, std::size_t first, const Field& x0, const Field& v0, Field& x, Field& v,
                          RestingPoints& points) {
  HWY_DYNAMIC_DISPATCH(solve_resting)(plan, h, first, x0.data(), v0.data(), x.data(), v.data(), points);
}

}  // namespace hooke
#endif
