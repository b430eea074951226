// Compiled once for each vector unit by Highway, which picks one at run time; the same IEEE operations in every width.
#include "sim/contact/resting_kernel.h"

#include <array>
#include <variant>

#include "sim/contact/point_contact.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/contact/resting_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "sim/contact/slide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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

// Whether points in flight certainly stay clear of the shape, which lies behind the tangent plane below their start: the minimum over the
// step of g + v t + a t^2 / 2, with g, v and a along the normal.
template <class Shape>
HWY_INLINE LaneMask stay_clear(const Shape& shape, const Step& step) {
  const Lane zero = same(0.0), h = same(step.h), half = same(0.5);
  const auto [gap, displacement, velocity_change] = approach_to(shape, step);
  const Lane lower = hn::Min(displacement, zero), margin = hn::Mul(same(1e-12), hn::Add(magnitude(step.x0), same(extent_of(shape))));
  const LaneMask ends_clear = hn::Gt(hn::Add(gap, lower), margin);
  if (hn::AllFalse(PointLanes(), ends_clear)) return ends_clear;  // as those that rest
  const Lane start = hn::Sub(displacement, hn::Mul(hn::Mul(half, h), velocity_change)), bend = hn::Mul(h, velocity_change);  // h v, h^2 a
  const LaneMask turns = hn::And(hn::Lt(start, zero), hn::Lt(hn::Neg(start), bend));
  const Lane at_turn = hn::IfThenElseZero(turns, hn::Neg(hn::Div(hn::Mul(half, hn::Mul(start, start)), bend)));
  return hn::Gt(hn::Add(gap, hn::Min(lower, at_turn)), margin);
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

// A point that stops under friction may take many segments: such points are solved again, together. And so are points of vectors in which
// few touch.
constexpr int first_segments = 2;
struct PointList {
  std::size_t count = 0;
  std::array<std::size_t, RestingPoints::max> point;
  std::array<const Collider*, RestingPoints::max> collider;
  HWY_INLINE void add(std::size_t i, const Collider& on) {
    point[count] = i;
    collider[count++] = &on;
  }
  // Points i, i + 1, .. as the bits say.
  HWY_INLINE void add(std::size_t i, unsigned bits, const Collider& on) {
    for (; bits != 0; bits >>= 1U, ++i)
      if ((bits & 1U) != 0) add(i, on);
  }
};

// Some points as the lanes of a vector.
HWY_INLINE LaneVec3 gather_points(const Plan& plan, const double* field, const std::int64_t* point) {
  const PointLanes d;
  const auto index = hn::LoadU(hn::RebindToSigned<PointLanes>(), point);
  const std::size_t n = static_cast<std::size_t>(plan.points);
  return {hn::GatherIndex(d, field, index), hn::GatherIndex(d, field + n, index),
          plan.dimensions == 3 ? hn::GatherIndex(d, field + 2 * n, index) : hn::Zero(d)};
}

// Solves the points of the list; those that need more segments go to `unfinished`, if it is given.
void solve_list(const Plan& plan, double h, std::size_t first, const PointList& list, int max_segments, const double* x0, const double* v0,
                double* x, double* v, RestingPoints& points, PointList* unfinished) {
  const PointLanes d;
  const std::size_t n = static_cast<std::size_t>(plan.points), lanes = hn::Lanes(d);
  for (const Collider& collider : plan.colliders)
    for (std::size_t next = 0; next < list.count;) {
      std::int64_t point[8] = {};
      std::size_t count = 0;
      for (; next < list.count && count < lanes; ++next)
        if (list.collider[next] == &collider) point[count++] = static_cast<std::int64_t>(list.point[next]);
      if (count == 0) break;
      for (std::size_t lane = count; lane < lanes; ++lane) point[lane] = point[count - 1];

      const auto index = hn::LoadU(hn::RebindToSigned<PointLanes>(), point);
      Step step{h,
                hn::GatherIndex(d, plan.radius.data(), index),
                gather_points(plan, x0, point),
                gather_points(plan, v0, point),
                gather_points(plan, x, point),
                gather_points(plan, v, point),
                {},
                {}};
      set_acceleration(step);
      const auto slide_on = [&](const auto& shape) HWY_ATTR {
        return slide(shape, collider.friction, step, lane_gap(shape, step.radius, step.x0), max_segments);
      };
      const auto* sphere = std::get_if<Sphere>(&collider.shape);
      const Corrected corrected = sphere != nullptr ? slide_on(*sphere) : slide_on(*std::get_if<Plane>(&collider.shape));
      double result[7][8];
      const Lane columns[] = {corrected.x.x,
                              corrected.x.y,
                              corrected.x.z,
                              corrected.v.x,
                              corrected.v.y,
                              corrected.v.z,
                              hn::Mul(hn::GatherIndex(d, plan.mass.data(), index), work_per_mass(step, corrected))};
      for (std::size_t column = 0; column < 7; ++column) hn::StoreU(columns[column], d, result[column]);
      const unsigned solved = bits_of(corrected.is_solved), more = bits_of(corrected.is_unfinished);
      for (std::size_t lane = 0; lane < count; ++lane) {
        const auto i = static_cast<std::size_t>(point[lane]);
        if (unfinished != nullptr && (more >> lane & 1U) != 0) {
          unfinished->add(i, collider);
          continue;
        }
        if ((solved >> lane & 1U) == 0) continue;
        for (std::size_t c = 0; c < static_cast<std::size_t>(plan.dimensions); ++c) {
          x[c * n + i] = result[c][lane];
          v[c * n + i] = result[3 + c][lane];
        }
        points.any_solved = true;
        points.work[i - first] = result[6][lane];
        points.outcome[i - first] = RestingPoints::Solved;
      }
    }
}

// What solve_resting has found so far: points of vectors in which few touch, and those that need more segments.
struct Later {
  PointList sparse, unfinished;
};

// Of the lanes `on`, which are near this collider alone: those that may touch it are corrected and `solved`, if they can be, or `open`.
template <class Shape>
HWY_INLINE void solve_on(const Plan& plan, const Collider& collider, const Shape& shape, Step& step, LaneMask on, std::size_t i, double* x,
                         double* v, Lane& work, LaneMask& open, LaneMask& solved, Later& later) {
  const PointLanes d;
  const LaneMask touching = hn::AndNot(stay_clear(shape, step), on);
  if (hn::AllFalse(d, touching)) return;
  open = hn::Or(open, touching);
  if (2 * hn::CountTrue(d, touching) <= hn::Lanes(d)) {
    later.sparse.add(i, bits_of(touching), collider);
    return;
  }
  set_acceleration(step);
  const Corrected corrected = slide(shape, collider.friction, step, lane_gap(shape, step.radius, step.x0), first_segments);
  const LaneMask here = hn::And(touching, hn::AndNot(corrected.is_unfinished, corrected.is_solved));
  store_point(plan, corrected.x, here, x, i);
  store_point(plan, corrected.v, here, v, i);
  work = hn::IfThenElse(here, hn::Mul(hn::LoadU(d, plan.mass.data() + i), work_per_mass(step, corrected)), work);
  solved = hn::Or(solved, here);
  const LaneMask more = hn::And(touching, corrected.is_unfinished);
  if (!hn::AllFalse(d, more)) later.unfinished.add(i, bits_of(more), collider);
}

void solve_resting(const Plan& plan, double h, std::size_t first, std::size_t end, const double* x0, const double* v0, double* x, double* v,
                   RestingPoints& points) {
  const PointLanes d;
  const std::size_t lanes = hn::Lanes(d);
  points.any_solved = points.any_open = false;
  Later later;
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
    Lane last = same(-1.0);  // the number of the last collider that is near
    double number = 0.0;
    for (const Collider& collider : plan.colliders) {
      const LaneMask near = may_reach(collider.shape, reach, step.x0);
      several = hn::Or(several, hn::And(any, near));
      any = hn::Or(any, near);
      last = hn::IfThenElse(near, same(number), last);
      number += 1.0;
    }
    any = hn::And(any, hn::Ne(hn::LoadU(d, plan.inverse_mass.data() + i), same(0.0)));
    RestingPoints::Outcome* const outcome = points.outcome + (i - first);
    for (std::size_t lane = 0; lane < lanes; ++lane) outcome[lane] = RestingPoints::Free;
    Lane work = same(0.0);
    if (!hn::AllFalse(d, any)) {
      LaneMask open = same_if(false), solved = open;
      several = hn::And(several, any);
      if (!hn::AllFalse(d, several))
        for (const Collider& collider : plan.colliders) {
          const LaneMask near = hn::And(several, may_reach(collider.shape, reach, step.x0));
          open = hn::Or(open, hn::AndNot(stay_clear(collider.shape, step), near));
        }
      const LaneMask alone = hn::AndNot(several, any);
      number = 0.0;
      for (const Collider& collider : plan.colliders) {
        const LaneMask on = hn::And(alone, hn::Eq(last, same(number)));
        number += 1.0;
        if (hn::AllFalse(d, on)) continue;
        if (const auto* sphere = std::get_if<Sphere>(&collider.shape))
          solve_on(plan, collider, *sphere, step, on, i, x, v, work, open, solved, later);
        else if (const auto* plane = std::get_if<Plane>(&collider.shape))
          solve_on(plan, collider, *plane, step, on, i, x, v, work, open, solved, later);
        else
          open = hn::Or(open, on);
      }
      if (!hn::AllFalse(d, open)) set_outcomes(bits_of(open), bits_of(solved), points, outcome);
    }
    hn::StoreU(work, d, points.work + (i - first));
  }
  for (; i < end; ++i) {
    points.outcome[i - first] = RestingPoints::Open;
    points.work[i - first] = 0.0;
    points.any_open = true;
  }
  solve_list(plan, h, first, later.sparse, first_segments, x0, v0, x, v, points, &later.unfinished);
  solve_list(plan, h, first, later.unfinished, max_path_segments, x0, v0, x, v, points, nullptr);
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(solve_resting);

void solve_resting_points(const Plan& plan, double h, std::size_t first, std::size_t end, const Field& x0, const Field& v0, Field& x,
                          Field& v, RestingPoints& points) {
  HWY_DYNAMIC_DISPATCH(solve_resting)(plan, h, first, end, x0.data(), v0.data(), x.data(), v.data(), points);
}

}  // namespace hooke
#endif
