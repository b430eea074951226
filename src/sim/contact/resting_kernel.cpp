// Compiled once for each vector unit by Highway, which picks one at run time; the same IEEE operations in every width.
#include "sim/contact/resting_kernel.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <type_traits>
#include <variant>

#include "sim/contact/constants.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/contact/resting_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "sim/forces/lane_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hooke::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE Lane length(const LaneVec3& a) { return hn::Sqrt(dot(a, a)); }
HWY_INLINE LaneVec3 across(const LaneVec3& normal, const LaneVec3& w) { return minus(w, times(dot(w, normal), normal)); }
// As contact_tolerance.
HWY_INLINE Lane tolerance_at(const LaneVec3& x) { return same(1e-13) * (same(1.0) + hn::Abs(x.x) + hn::Abs(x.y) + hn::Abs(x.z)); }

struct LaneGap {
  Lane distance;
  LaneVec3 normal;
  Lane curvature;
};
HWY_INLINE LaneGap lane_gap(const Sphere& sphere, Lane radius, const LaneVec3& x) {
  const LaneVec3 out = minus(x, same(sphere.center));
  const Lane distance = length(out), inflated_radius = same(sphere.radius) + radius;
  return {distance - inflated_radius, times(same(1.0) / distance, out), same(1.0) / inflated_radius};
}
HWY_INLINE LaneGap lane_gap(const Plane& plane, Lane radius, const LaneVec3& x) {
  const LaneVec3 normal = same(plane.normal);
  return {dot(normal, minus(x, same(plane.point))) - radius, normal, same(0.0)};
}
// Not a number inside.
HWY_INLINE LaneGap lane_gap(const Box& box, Lane radius, const LaneVec3& x) {
  const auto outside = [](Lane at, double min, double max) HWY_ATTR { return at - hn::Max(same(min), hn::Min(at, same(max))); };
  const LaneVec3 out{outside(x.x, box.min.x, box.max.x), outside(x.y, box.min.y, box.max.y), outside(x.z, box.min.z, box.max.z)};
  const Lane distance = length(out);
  return {distance - radius, times(same(1.0) / distance, out), same(0.0)};
}

// Points during a step without contact, perhaps relative to an obstacle.
struct Path {
  LaneVec3 x0, v0, x1, v1;
};
HWY_INLINE bool is_in_place(const Obstacle& obstacle) { return obstacle.offset == Vec3(0.0) && !moves(obstacle); }
HWY_INLINE Path relative_to(const Obstacle& obstacle, double h, const Path& path) {
  return {minus(path.x0, same(obstacle.offset)), minus(path.v0, same(obstacle.velocity)), minus(path.x1, same(obstacle.offset_at(h))),
          minus(path.v1, same(obstacle.velocity_at(h)))};
}
// 1-norm
HWY_INLINE Lane size_of(const LaneVec3& a) { return hn::Abs(a.x) + hn::Abs(a.y) + hn::Abs(a.z); }

// Whether points certainly do not touch a shape, which lies behind the tangent plane below their start: paths deviate from the straight
// line by at most an eighth of h times the change of their velocity. False if a number is NaN.
template <class Shape>
HWY_INLINE LaneMask is_clear_of_shape(const Shape& shape, double h, Lane radius, const Path& path) {
  const LaneGap gap = lane_gap(shape, radius, path.x0);
  const Lane end = hn::Min(same(0.0), dot(gap.normal, minus(path.x1, path.x0)));
  const Lane bulge = same(0.125 * h) * hn::Abs(dot(gap.normal, minus(path.v1, path.v0)));
  return hn::Gt(gap.distance + end - bulge, tolerance_at(path.x0));
}
HWY_INLINE LaneMask is_clear(const ColliderShape& shape, double h, Lane radius, const Path& path) {
  if (const auto* plane = std::get_if<Plane>(&shape)) return is_clear_of_shape(*plane, h, radius, path);
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return is_clear_of_shape(*sphere, h, radius, path);
  return is_clear_of_shape(*std::get_if<Box>(&shape), h, radius, path);
}
HWY_INLINE LaneMask is_clear(const Obstacle& obstacle, double h, Lane radius, const Path& path) {
  if (is_in_place(obstacle)) return is_clear(obstacle.collider->shape, h, radius, path);
  return is_clear(obstacle.collider->shape, h, radius, relative_to(obstacle, h, path));
}

struct Corrected {
  LaneVec3 x, v;          // at the end, v with the correction of the method's path
  LaneVec3 start, extra;  // velocities: at the start with that correction, and that correction at the end
  LaneMask is_solved, moves;
};

// From the tangent plane at the start, where the normal acceleration is `load`, down to the ball.
HWY_INLINE void follow_ball(const LaneGap& gap, Lane load, double friction, double h, const LaneVec3& a, const LaneVec3& x0,
                            Corrected& end) {
  const Lane zero = same(0.0), half_time = same(0.5 * h), radius = same(1.0) / gap.curvature;
  const LaneVec3 displacement = minus(end.x, x0);
  const Lane square = dot(displacement, displacement);
  const Lane fall = zero - square / (radius + hn::Sqrt(radius * radius - square));
  const LaneVec3 normal = plus(gap.normal, times(gap.curvature, plus(displacement, times(fall, gap.normal))));
  const LaneVec3 velocity = across(normal, plus(end.v, times(fall / same(h) + half_time * dot(a, gap.normal), gap.normal)));
  const Lane speed = length(velocity);
  const Lane end_load = hn::Max(zero, zero - dot(a, normal) - gap.curvature * dot(velocity, velocity));
  const Lane rest = hn::Max(zero, same(1.0) - half_time * same(friction) * (end_load - load) / speed);
  end.x = plus(end.x, times(fall, gap.normal));
  end.v = times(hn::IfThenElse(hn::Gt(speed, zero), rest, zero), velocity);
}

// Along a shape at rest.
template <class Shape>
HWY_INLINE Corrected slide(const Shape& shape, double friction, double lag, double h, double unknown_speed, Lane radius, const Path& path) {
  constexpr bool is_curved = std::is_same_v<Shape, Sphere>;
  const Lane zero = same(0.0), time = same(h);
  const LaneVec3 none{zero, zero, zero}, change = minus(path.v1, path.v0), a = times(same(1.0 / h), change);
  const LaneGap gap = lane_gap(shape, radius, path.x0);
  const Lane round_off = same(1e-12) * size_of(change);

  // on the surface, moving neither into it nor away from it, and pressing on it
  Corrected end{path.x0, none, path.v0, none, {}, hn::FirstN(Lanes(), 0)};
  end.is_solved = hn::And(hn::Le(hn::Abs(gap.distance), tolerance_at(path.x0)),
                          hn::Le(hn::Abs(dot(path.v0, gap.normal)), round_off + same(1e-12) * size_of(path.v0) + same(unknown_speed)));
  if (hn::AllFalse(Lanes(), end.is_solved)) return end;
  if (friction == 0.0) {
    const LaneVec3 mean = times(same(0.5), plus(path.v0, path.v1));
    end.extra = across(gap.normal, minus(times(same(1.0 / h), minus(path.x1, path.x0)), mean));
    end.start = plus(path.v0, end.extra);
  }
  const Lane load = zero - dot(gap.normal, a) - gap.curvature * dot(end.start, end.start);
  end.is_solved = hn::And(end.is_solved, hn::Gt(load * time, round_off));

  // friction takes the direction of the end; what it stops within the step starts anew from rest, as far as forces then exceed it. It can
  // stop no more than its impulse across the force
  const LaneVec3 drive = across(gap.normal, change);
  const Lane one = same(1.0), loss = same(friction) * load * time, square = dot(end.start, end.start), bound = loss + round_off;
  if (hn::AllTrue(Lanes(), hn::Or(hn::Not(end.is_solved), hn::And(hn::Eq(square, zero), hn::Le(dot(drive, drive), bound * bound)))))
    return end;  // all of them are at rest
  const Lane along = dot(drive, end.start), slowing = loss * hn::Sqrt(square) - along, drive_square = dot(drive, drive);
  const LaneMask can_stop = hn::Le(square * drive_square - along * along, loss * loss * drive_square);
  const LaneMask stops = hn::And(can_stop, hn::And(hn::Gt(slowing, square), hn::Gt(same(lag == 0.0 ? 1.0 : 0.0), zero)));
  const Lane until = hn::IfThenElse(stops, square / slowing, one), left = hn::IfThenElse(stops, one - until, one);
  const LaneVec3 driven = choose(stops, drive, plus(end.start, drive));
  const Lane speed = length(driven);
  const LaneMask sticks = hn::Le(speed, bound);
  end.v = choose(sticks, none, times(left * (one - loss / speed), driven));
  if (lag != 0.0) {
    end.extra = choose(sticks, none, times(same(lag), minus(end.v, end.start)));
    end.start = plus(end.start, end.extra);
    end.v = plus(end.v, end.extra);
  }
  LaneVec3 displacement = times(same(0.5 * h), plus(times(until, end.start), times(left, end.v)));
  if (lag != 0.0) displacement = choose(sticks, none, displacement);
  end.x = plus(path.x0, displacement);
  if constexpr (is_curved) {
    const LaneVec3 change_along = minus(end.v, end.start);
    const Lane falls = gap.curvature * (dot(end.start, change) + same(2.0) * dot(end.start, change_along));
    const Lane arc = gap.curvature * time * (length(end.start) + length(change_along));
    end.is_solved = hn::And(end.is_solved, hn::Or(sticks, hn::And(hn::Le(arc, same(contact::max_arc)), hn::Le(falls, load))));
    follow_ball(gap, load, friction, h, a, path.x0, end);
  }

  // round-off, and what does not move keeps its bits
  const LaneGap on = lane_gap(shape, radius, end.x);
  end.moves = hn::Gt(size_of(displacement), zero);
  end.x = choose(end.moves, minus(end.x, times(on.distance, on.normal)), path.x0);
  end.v = choose(sticks, none, across(on.normal, end.v));
  end.extra = choose(sticks, none, across(on.normal, end.extra));
  return end;
}

// The first `count` lanes, others 0; a whole vector, if there is no limit.
constexpr std::size_t whole = ~std::size_t{0};
HWY_INLINE Lane load(const double* from, std::size_t count) {
  const Lanes d;
  if (count == whole) return hn::LoadU(d, from);
  HWY_ALIGN double values[8] = {};
  std::copy_n(from, count, values);
  return hn::Load(d, values);
}
HWY_INLINE LaneVec3 load_point(const Plan& plan, const double* field, std::size_t i, std::size_t count) {
  const std::size_t n = static_cast<std::size_t>(plan.points);
  return {load(field + i, count), load(field + n + i, count), plan.dimensions == 3 ? load(field + 2 * n + i, count) : same(0.0)};
}

// One per lane, from the lowest bit up.
HWY_INLINE unsigned bits_of(LaneMask mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Lanes(), mask, bits);
  return bits[0];
}

// The first `count` lanes: what is behind them may belong to another thread, or to nobody.
HWY_INLINE void store(Lane value, LaneMask mask, std::size_t count, double* to) {
  const Lanes d;
  if (count == whole) return hn::BlendedStore(value, mask, d, to);
  HWY_ALIGN double values[8];
  hn::Store(value, d, values);
  const unsigned bits = bits_of(mask);
  for (std::size_t lane = 0; lane < count; ++lane)
    if ((bits >> lane & 1U) != 0) to[lane] = values[lane];
}
HWY_INLINE void store_point(const Plan& plan, const LaneVec3& value, LaneMask mask, std::size_t count, double* field, std::size_t i) {
  const std::size_t n = static_cast<std::size_t>(plan.points);
  store(value.x, mask, count, field + i);
  store(value.y, mask, count, field + n + i);
  if (plan.dimensions == 3) store(value.z, mask, count, field + 2 * n + i);
}

// Some points of a field in a step.
struct Block {
  const Plan& plan;
  std::span<const Obstacle> obstacles;
  double h, lag;
  const char* left_out;  // per point; null: none is
  const double *x0, *v0;
  double *x, *v;
};

// The points from i on that are `alone` on the obstacle. Returns those that were solved.
HWY_INLINE LaneMask solve_on(const Block& block, const Obstacle& obstacle, const Path& path, Lane radius, LaneMask alone, std::size_t i,
                             std::size_t count, RestingPoints& points, std::size_t at) {
  const Lanes d;
  const Collider& collider = *obstacle.collider;
  const double h = block.h, lag = collider.friction > 0.0 ? block.lag : 0.0;
  // the velocity of what moves is known up to the rounding of the time
  const double unknown = 1e-9 * (glm::length(obstacle.velocity) + h * glm::length(obstacle.acceleration));
  const auto slide_on = [&](const Path& relative) HWY_ATTR {
    if (const auto* plane = std::get_if<Plane>(&collider.shape)) return slide(*plane, collider.friction, lag, h, unknown, radius, relative);
    return slide(*std::get_if<Sphere>(&collider.shape), collider.friction, lag, h, unknown, radius, relative);
  };
  const Corrected end = is_in_place(obstacle) ? slide_on(path) : slide_on(relative_to(obstacle, h, path));
  LaneMask solved = hn::And(alone, end.is_solved);
  LaneVec3 x = end.x, v = minus(end.v, end.extra), start = end.start, with_extra = end.v;
  if (!is_in_place(obstacle)) {
    x = plus(x, same(obstacle.offset_at(h)));
    v = plus(v, same(obstacle.velocity_at(h)));
    start = plus(start, same(obstacle.velocity + obstacle.velocity_correction));
    with_extra = plus(with_extra, same(obstacle.velocity_at(h) + obstacle.velocity_correction));
  }

  // not into another obstacle
  for (const Obstacle& other : block.obstacles)
    if (&other != &obstacle && !hn::AllFalse(d, end.moves)) solved = hn::And(solved, is_clear(other, h, radius, {path.x0, path.v0, x, v}));
  if (hn::AllFalse(d, solved)) return solved;
  const LaneVec3 change = minus(path.v1, path.v0);
  const Lane mass = load(block.plan.mass.data() + i, count);
  const Lane kinetic = same(0.5) * (dot(with_extra, with_extra) - dot(start, start));
  const Lane work = mass * (kinetic - dot(change, minus(x, path.x0)) / same(h));
  store(work, solved, count, points.work + at);
  store_point(block.plan, x, solved, count, block.x, i);
  store_point(block.plan, v, solved, count, block.v, i);
  return solved;
}

// The points from i on, one per lane.
HWY_INLINE void solve_points(const Block& block, std::size_t i, std::size_t count, RestingPoints& points, std::size_t at) {
  const Lanes d;
  const std::size_t lanes = std::min(count, hn::Lanes(d));
  const Path path{load_point(block.plan, block.x0, i, count), load_point(block.plan, block.v0, i, count),
                  load_point(block.plan, block.x, i, count), load_point(block.plan, block.v, i, count)};
  const Lane radius = load(block.plan.radius.data() + i, count);
  Lane inverse_mass = load(block.plan.inverse_mass_in_contact().data() + i, count);
  if (block.left_out != nullptr) {
    HWY_ALIGN double is_in[8] = {};
    for (std::size_t lane = 0; lane < lanes; ++lane) is_in[lane] = block.left_out[i + lane] == 0 ? 1.0 : 0.0;
    inverse_mass = inverse_mass * hn::Load(d, is_in);
  }
  const LaneMask may_move = hn::Ne(inverse_mass, same(0.0));
  LaneMask open = hn::FirstN(d, 0), several = open, solved = open;
  const auto touching = [&](const Obstacle& obstacle) HWY_ATTR { return hn::AndNot(is_clear(obstacle, block.h, radius, path), may_move); };
  const Obstacle* last = nullptr;  // that any of them touches
  bool is_only = true;
  for (const Obstacle& obstacle : block.obstacles) {
    const LaneMask touches = touching(obstacle);
    if (hn::AllFalse(d, touches)) continue;
    several = hn::Or(several, hn::And(open, touches));
    open = hn::Or(open, touches);
    is_only = last == nullptr;
    last = &obstacle;
  }
  if (count == whole)
    hn::StoreU(same(0.0), d, points.work + at);
  else
    std::fill_n(points.work + at, lanes, 0.0);
  for (std::size_t lane = 0; lane < lanes; ++lane) points.outcome[at + lane] = RestingPoints::Free;
  if (last == nullptr) return;
  const unsigned open_bits = bits_of(open);
  for (const Obstacle& obstacle : is_only ? std::span(last, 1) : block.obstacles) {
    const ColliderPath& own = obstacle.collider->path;
    if (own.spin != Vec3(0.0) || own.belt != Vec3(0.0) || std::holds_alternative<Box>(obstacle.collider->shape)) continue;
    const LaneMask alone = hn::AndNot(several, is_only ? open : touching(obstacle));
    if (!hn::AllFalse(d, alone)) solved = hn::Or(solved, solve_on(block, obstacle, path, radius, alone, i, count, points, at));
  }
  const unsigned solved_bits = bits_of(solved);
  points.any_solved = points.any_solved || solved_bits != 0;
  points.any_open = points.any_open || (open_bits & ~solved_bits) != 0;
  for (std::size_t lane = 0; lane < lanes; ++lane)
    if ((open_bits >> lane & 1U) != 0)
      points.outcome[at + lane] = (solved_bits >> lane & 1U) != 0 ? RestingPoints::Solved : RestingPoints::Open;
}

void solve_resting(const Plan& plan, std::span<const Obstacle> obstacles, double h, double lag, const char* left_out, std::size_t first,
                   std::size_t end, const double* x0, const double* v0, double* x, double* v, RestingPoints& points) {
  const std::size_t lanes = hn::Lanes(Lanes());
  const Block block{plan, obstacles, h, lag, left_out, x0, v0, x, v};
  points.any_solved = points.any_open = false;
  std::size_t i = first;
  for (; i + lanes <= end; i += lanes) solve_points(block, i, whole, points, i - first);
  if (i < end) solve_points(block, i, end - i, points, i - first);
}

}  // namespace hooke::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hooke {

HWY_EXPORT(solve_resting);

void solve_resting_points(const Plan& plan, std::span<const Obstacle> obstacles, double h, double lag, const char* left_out,
                          std::size_t first, std::size_t end, const Field& x0, const Field& v0, Field& x, Field& v, RestingPoints& points) {
  HWY_DYNAMIC_DISPATCH(solve_resting)
  (plan, obstacles, h, lag, left_out, first, end, x0.data(), v0.data(), x.data(), v.data(), points);
}

}  // namespace hooke
#endif
