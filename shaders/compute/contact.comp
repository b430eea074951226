// Points against planes, spheres and boxes in one substep: one thread for each point, by the formulas of src/sim/contact. The start of the
// substep is in `from`, and where the method led in `to`, which is corrected. First what rests or slides on one plane or ball for all of the
// substep (resting_kernel.cpp), then all else: impacts in the order of time on the parabola of the point (touch_simulation.cpp).

struct Collider {
  real4 first;   // point, center or minimum; w: 0 a plane, 1 a sphere, 2 a box
  real4 second;  // normal or maximum; w: radius
  real4 spin;    // [rad/s]; w: restitution
  real4 belt;    // [m/s]; w: friction
};
// Its displacement in a substep, on a parabola (src/sim/contact/obstacle.h).
struct Obstacle {
  real4 offset, velocity, acceleration, correction;
};
layout(std430, binding = 15) buffer Colliders {
  Collider colliders[COLLIDERS];
  Obstacle obstacles[];  // those of the first substep, then those of the next
};

#if SINGLE
const real distance_round_off = 1e-6, round_off = 1e-5, time_round_off = 1e-5, solver_round_off = 1e-7, epsilon = 1.2e-7;
#else
const real distance_round_off = 1e-13lf, round_off = 1e-12lf, time_round_off = 1e-9lf, solver_round_off = 1e-14lf, epsilon = 2.2e-16lf;
#endif
const real never = 1e30;
const real max_arc = 0.125;  // src/sim/contact/constants.h
const int max_sweeps = 200, max_impacts = 64;

real size_of(real3 a) { return abs(a.x) + abs(a.y) + abs(a.z); }
real norm(real3 a) { return sqrt(dot(a, a)); }
real3 across(real3 normal, real3 w) { return w - dot(w, normal) * normal; }
real tolerance_at(real3 x) { return distance_round_off * (1.0 + size_of(x)); }

Obstacle obstacle(int c) { return obstacles[substep * COLLIDERS + c]; }
real3 offset_at(Obstacle o, real t) { return o.offset.xyz + t * (o.velocity.xyz + o.correction.xyz + 0.5 * t * o.acceleration.xyz); }
real3 velocity_at(Obstacle o, real t) { return o.velocity.xyz + t * o.acceleration.xyz; }
bool is_moving(Obstacle o) { return o.velocity.xyz != real3(0.0) || o.acceleration.xyz != real3(0.0); }

// Between a point of a radius at x and a collider in its place.
struct Gap {
  real distance;
  real3 normal;
  real curvature;
  real3 curved;  // 0: an axis along which it is straight
};

Gap gap_to(int c, real radius, real3 x) {
  Collider collider = colliders[c];
  real3 first = collider.first.xyz, second = collider.second.xyz;
  if (collider.first.w == 0.0) return Gap(dot(second, x - first) - radius, second, 0.0, real3(1.0));
  if (collider.first.w == 1.0) {
    real3 outward = x - first;
    real len = norm(outward), inflated = collider.second.w + radius;
    return Gap(len - inflated, len > 0.0 ? outward / len : real3(0.0, 1.0, 0.0), 1.0 / inflated, real3(1.0));
  }
  real3 outward = x - clamp(x, first, second);
  real len = norm(outward);
  if (len > 0.0) {
    // round edges on cylinders, and round corners on balls
    real3 curved = real3(notEqual(outward, real3(0.0)));
    bool is_round = radius > 0.0 && curved.x + curved.y + curved.z > 1.0;
    return Gap(len - radius, outward / len, is_round ? 1.0 / radius : real(0.0), curved);
  }
  // inside: out through the nearest face
  Gap gap = Gap(-never, real3(0.0), 0.0, real3(1.0));
  for (int k = 0; k < 3; ++k)
    for (int side = -1; side <= 1; side += 2) {
      real distance = side > 0 ? x[k] - second[k] : first[k] - x[k];
      if (distance <= gap.distance) continue;
      gap.distance = distance;
      gap.normal = real3(0.0);
      gap.normal[k] = real(side);
    }
  gap.distance -= radius;
  return gap;
}

// Of a belt or a spin, relative to the shape.
real3 surface_velocity(int c, real3 normal, real3 x) {
  Collider collider = colliders[c];
  real3 velocity = across(normal, collider.belt.xyz);
  if (collider.first.w != 2.0) velocity += cross(collider.spin.xyz, x - collider.first.xyz);
  return velocity;
}

// The step without contact, perhaps relative to an obstacle.
struct Free {
  real3 x0, v0, x1, v1;
};

Free relative_to(Obstacle o, real h, Free path) {
  return Free(path.x0 - o.offset.xyz, path.v0 - o.velocity.xyz, path.x1 - offset_at(o, h), path.v1 - velocity_at(o, h));
}

// Whether the point certainly does not touch the collider, which lies behind its tangent plane.
bool is_clear(int c, real h, real radius, Free path) {
  Free seen = relative_to(obstacle(c), h, path);
  Gap gap = gap_to(c, radius, seen.x0);
  real end = min(real(0.0), dot(gap.normal, seen.x1 - seen.x0));
  real bulge = 0.125 * h * abs(dot(gap.normal, seen.v1 - seen.v0));
  return gap.distance + end - bulge > tolerance_at(seen.x0);
}

struct Corrected {
  real3 x, v;          // at the end, v with the correction of the method's path
  real3 start, extra;  // velocities: at the start with that correction, and that correction at the end
  bool is_solved, moves;
};

// From the tangent plane at the start, where the normal acceleration is `load`, down to the ball.
void follow_ball(Gap gap, real load, real friction, real h, real3 a, real3 x0, inout Corrected end) {
  real radius = 1.0 / gap.curvature;
  real3 displacement = end.x - x0;
  real square = dot(displacement, displacement);
  real fall = -square / (radius + sqrt(radius * radius - square));
  real3 normal = gap.normal + gap.curvature * (displacement + fall * gap.normal);
  real3 velocity = across(normal, end.v + (fall / h + 0.5 * h * dot(a, gap.normal)) * gap.normal);
  real speed = norm(velocity);
  real end_load = max(real(0.0), -dot(a, normal) - gap.curvature * dot(velocity, velocity));
  end.x += fall * gap.normal;
  end.v = speed > 0.0 ? max(real(0.0), 1.0 - 0.5 * h * friction * (end_load - load) / speed) * velocity : real3(0.0);
}

// Along a plane or ball at rest. `lag`: of the method, where there is friction.
Corrected slide(int c, real lag, real h, real unknown_speed, real radius, Free path) {
  real friction = colliders[c].belt.w;
  real3 change = path.v1 - path.v0, a = change / h;
  Gap gap = gap_to(c, radius, path.x0);
  real rounding = round_off * size_of(change);
  Corrected end = Corrected(path.x0, real3(0.0), path.v0, real3(0.0), false, false);

  // on the surface, moving neither into it nor away from it, and pressing on it
  if (abs(gap.distance) > tolerance_at(path.x0)) return end;
  if (abs(dot(path.v0, gap.normal)) > rounding + round_off * size_of(path.v0) + unknown_speed) return end;
  if (friction == 0.0) {
    end.extra = across(gap.normal, (path.x1 - path.x0) / h - 0.5 * (path.v0 + path.v1));
    end.start = path.v0 + end.extra;
  }
  real load = -dot(gap.normal, a) - gap.curvature * dot(end.start, end.start);
  if (!(load * h > rounding)) return end;
  end.is_solved = true;

  // friction takes the direction of the end; what it stops within the step starts anew from rest, as far as forces then exceed it. It can
  // stop no more than its impulse across the force
  real3 drive = across(gap.normal, change);
  real loss = friction * load * h, square = dot(end.start, end.start), bound = loss + rounding;
  if (square == 0.0 && dot(drive, drive) <= bound * bound) return end;
  real along = dot(drive, end.start), slowing = loss * sqrt(square) - along, drive_square = dot(drive, drive);
  bool can_stop = square * drive_square - along * along <= loss * loss * drive_square;
  bool stops = can_stop && slowing > square && lag == 0.0;
  real until = stops ? square / slowing : real(1.0), left = stops ? 1.0 - until : real(1.0);
  real3 driven = stops ? drive : end.start + drive;
  real speed = norm(driven);
  bool sticks = speed <= bound;
  end.v = sticks ? real3(0.0) : left * (1.0 - loss / speed) * driven;
  if (lag != 0.0) {
    end.extra = sticks ? real3(0.0) : lag * (end.v - end.start);
    end.start += end.extra;
    end.v += end.extra;
  }
  real3 displacement = sticks && lag != 0.0 ? real3(0.0) : 0.5 * h * (until * end.start + left * end.v);
  end.x = path.x0 + displacement;
  if (gap.curvature != 0.0) {
    real3 change_along = end.v - end.start;
    real falls = gap.curvature * (dot(end.start, change) + 2.0 * dot(end.start, change_along));
    real arc = gap.curvature * h * (norm(end.start) + norm(change_along));
    end.is_solved = sticks || (arc <= max_arc && falls <= load);
    follow_ball(gap, load, friction, h, a, path.x0, end);
  }

  // round-off, and what does not move keeps its bits
  Gap on = gap_to(c, radius, end.x);
  end.moves = size_of(displacement) > 0.0;
  end.x = end.moves ? end.x - on.distance * on.normal : path.x0;
  end.v = sticks ? real3(0.0) : across(on.normal, end.v);
  end.extra = sticks ? real3(0.0) : across(on.normal, end.extra);
  return end;
}

// Of a point that touches only this collider. Returns whether x and v are its end. `work`: of contact, per mass.
bool solve_resting(int c, real h, real radius, Free path, out real3 x, out real3 v, out real work) {
  Collider collider = colliders[c];
  if (collider.spin.xyz != real3(0.0) || collider.belt.xyz != real3(0.0) || collider.first.w == 2.0) return false;
  Obstacle o = obstacle(c);
  real unknown = time_round_off * (norm(o.velocity.xyz) + h * norm(o.acceleration.xyz));
  Corrected end = slide(c, collider.belt.w > 0.0 ? substeps.y : real(0.0), h, unknown, radius, relative_to(o, h, path));
  if (!end.is_solved) return false;
  x = end.x + (offset_at(o, h));
  v = end.v - end.extra + velocity_at(o, h);
  real3 start = end.start + o.velocity.xyz + o.correction.xyz, with_extra = end.v + velocity_at(o, h) + o.correction.xyz;
  if (!is_moving(o) && o.offset.xyz == real3(0.0)) {
    x = end.x;
    v = end.v - end.extra;
  }
  // not into another collider
  for (int other = 0; other < COLLIDERS && end.moves; ++other)
    if (other != c && !is_clear(other, h, radius, Free(path.x0, path.v0, x, v))) return false;
  work = 0.5 * (dot(with_extra, with_extra) - dot(start, start)) - dot(path.v1 - path.v0, x - path.x0) / h;
  return true;
}

// The path of the point: a parabola from `time` on, with the correction of the method's path in v.
real3 px, pv, pa, correction, free_correction, free_acceleration, start_x, start_v;  // start_v: without what contacts at rest do without work
real path_time, base, left, velocity_change, radius_of_point, work_of_forces, pushed;  // base: of path times, since the start of the substep
bool is_changed, is_listed;
real3 displaced;  // [m], until the end of the substep, by the changes of velocity of impacts with a rebound
real3 velocity;  // that impulses change

// What it may touch.
struct Touch {
  real time;
  bool is_at_rest, rebounds, is_together;
  real3 normal, surface, friction, curved;  // friction: impulse per mass [m/s]
  real curvature, min_velocity, impulse;
};
Touch touches[COLLIDERS];

real3 position(real t) { return px + (t - path_time) * (pv + 0.5 * (t - path_time) * pa); }
real3 velocity_of_path(real t) { return pv + (t - path_time) * pa; }
void advance(real t) {
  px = position(t);
  pv = velocity_of_path(t);
  path_time = t;
}
// Of the obstacle, with the correction of its own path.
real3 obstacle_velocity(int c, real t) { return velocity_at(obstacle(c), base + t) + obstacle(c).correction.xyz; }
real3 obstacle_offset(int c, real t) { return offset_at(obstacle(c), base + t); }
real change_of(int c) { return velocity_change + substeps.x * norm(obstacle(c).acceleration.xyz); }
real quiet_speed(int c, real t) {
  return round_off * (change_of(c) + norm(pv)) +
         time_round_off * (norm(obstacle_velocity(c, t)) + substeps.x * norm(obstacle(c).acceleration.xyz));
}

// When c + v t + a t^2 / 2, c >= 0, first goes below zero.
real first_zero_crossing(real c, real v, real a) {
  if (v >= 0.0 && a >= 0.0) return never;
  real discriminant = v * v - 2.0 * a * c;
  if (discriminant < 0.0) return never;
  real root = sqrt(discriminant);
  if (v > 0.0) return (v + root) / -a;
  return c == 0.0 ? real(0.0) : 2.0 * c / (root - v);
}

// The first time up to the limit at which a path relative to the collider touches it while moving inwards (gap.cpp).
real first_impact(int c, real3 x, real3 v, real3 a, real limit) {
  real t = 0.0;
  for (int k = 0; k < 128; ++k) {
    real3 xt = x + t * (v + 0.5 * t * a), vt = v + t * a;
    Gap gap = gap_to(c, radius_of_point, xt);
    bool touches_now = gap.distance <= tolerance_at(xt);
    if (touches_now && dot(gap.normal, vt) < 0.0) return t;
    real outside = first_zero_crossing(max(real(0.0), gap.distance), dot(gap.normal, vt), dot(gap.normal, a));
    if (outside < never && colliders[c].first.w == 1.0) {
      real3 d = xt - colliders[c].first.xyz;
      real start = max(real(0.0), gap.distance) * (norm(d) + colliders[c].second.w + radius_of_point);
      real square = dot(vt, vt) + dot(d, a) - abs(dot(vt, a)) * (limit - t);
      real on_sphere = first_zero_crossing(start, 2.0 * dot(d, vt), 2.0 * square);
      outside = on_sphere < never ? max(outside, on_sphere) : never;
    }
    if (outside >= never) return never;
    if (touches_now && outside == 0.0) return t;
    t += touches_now ? max(outside, time_round_off * limit) : outside;
    if (t > limit) return never;
  }
  return t;
}

// Changes `velocity` by the impulses of the touches that are at rest, or together in an impact: projected Gauss-Seidel, forward and backward
// in turn. `others`: the velocities of the obstacles without and with their correction, or only that.
void solve_impulses(bool resting, int kind, real t, real tolerance) {
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    real change = 0.0;
    for (int n = 0; n < COLLIDERS; ++n) {
      int c = sweep % 2 == 0 ? n : COLLIDERS - 1 - n;
      if (!(resting ? touches[c].is_at_rest : touches[c].is_together)) continue;
      real3 other = kind == 2 ? obstacle(c).correction.xyz : velocity_at(obstacle(c), base + t);
      if (kind == 1) other += obstacle(c).correction.xyz;
      real3 relative = velocity - other - touches[c].surface, normal = touches[c].normal;
      real normal_velocity = dot(normal, relative), before = touches[c].impulse;
      real impulse = max(real(0.0), before + (touches[c].min_velocity - normal_velocity));
      if (impulse == 0.0 && before == 0.0) continue;
      touches[c].impulse = impulse;
      real3 total = (impulse - before) * normal, friction_before = touches[c].friction;
      real mu = colliders[c].belt.w;
      if (mu != 0.0) {
        real3 friction = friction_before - (relative - normal_velocity * normal);
        real square = dot(friction, friction), most = mu * impulse;
        if (square > most * most) friction *= most / sqrt(square);
        touches[c].friction = friction;
        total += friction - friction_before;
      }
      velocity += total;
      change = max(change, max(abs(impulse - before), norm(touches[c].friction - friction_before)));
    }
    if (!(change > tolerance)) break;
  }
}

void note_change() { is_changed = is_listed = true; }

// Solves for the touches at rest, of the motion at a time or of the corrections (kind 2). What then rests does so without rounding.
void solve_velocities(int kind, real t, real tolerance) {
  for (int c = 0; c < COLLIDERS; ++c) {
    if (!touches[c].is_at_rest) continue;
    touches[c].surface = real3(0.0);
    if (kind == 2) continue;
    real3 seen = px - obstacle_offset(c, 0.0) + t * (pv - obstacle_velocity(c, 0.0));
    touches[c].surface = surface_velocity(c, touches[c].normal, seen);
  }
  solve_impulses(true, kind, t, tolerance);
  for (int c = 0; c < COLLIDERS; ++c) {
    if (!touches[c].is_at_rest) continue;
    real3 rest = (kind == 2 ? obstacle(c).correction.xyz : velocity_at(obstacle(c), base + t)) + touches[c].surface, slip = velocity - rest;
    if (slip != real3(0.0) && norm(slip) <= round_off * (change_of(c) + norm(rest))) {
      velocity = rest;
      note_change();
    }
    if (touches[c].impulse != 0.0) note_change();
  }
}

void forget_impulses() {
  for (int c = 0; c < COLLIDERS; ++c) {
    touches[c].impulse = touches[c].min_velocity = 0.0;
    touches[c].friction = real3(0.0);
  }
}

// Corrections of what presses on a collider come from forces that are balanced; so do those along the surface under friction.
void leave_corrections() {
  for (int c = 0; c < COLLIDERS; ++c) {
    if (!touches[c].is_at_rest) continue;
    Obstacle o = obstacle(c);
    real3 v = pv - correction - velocity_at(o, base), normal = touches[c].normal;
    if (!(dot(normal, pa - o.acceleration.xyz) + touches[c].curvature * dot(touches[c].curved * v, v) < 0.0)) continue;
    real3 part = velocity - o.correction.xyz;
    velocity -= colliders[c].belt.w > 0.0 ? part : dot(normal, part) * normal;
    note_change();
  }
}

// First velocities change at once, so that nothing closes; then corrections; then forces act, so that nothing overlaps at the end.
void rest() {
  real scale = 0.0;
  for (int c = 0; c < COLLIDERS; ++c)
    if (touches[c].is_at_rest) scale = max(scale, max(change_of(c), quiet_speed(c, 0.0)));
  real tolerance = solver_round_off * scale;

  velocity = pv - correction;
  forget_impulses();
  solve_velocities(0, 0.0, tolerance);
  if (is_listed) pv = velocity + correction;

  velocity = correction;
  forget_impulses();
  leave_corrections();
  solve_velocities(2, 0.0, tolerance);
  if (is_listed) {
    pv += velocity - correction;
    start_v += velocity - correction;
    correction = velocity;
  }

  // along the normal in the middle of the path, across which a slide on a ball leads: the force does no work
  forget_impulses();
  for (int c = 0; c < COLLIDERS; ++c) {
    if (!touches[c].is_at_rest) continue;
    Obstacle o = obstacle(c);
    real3 v = pv - correction - velocity_at(o, base), normal = touches[c].normal;
    real3 bent = normal + 0.5 * left * touches[c].curvature * touches[c].curved * across(normal, v + 0.5 * left * (pa - o.acceleration.xyz));
    touches[c].normal = bent / norm(bent);
    touches[c].min_velocity = min(real(0.0), -dot(touches[c].normal, v));
  }
  velocity = pv - correction + left * pa;
  solve_velocities(0, left, tolerance);
  if (is_listed) pa = (velocity - (pv - correction)) / left;
}

// What touches and neither approaches nor leaves. Returns whether anything does.
bool find_resting() {
  bool any = false;
  for (int c = 0; c < COLLIDERS; ++c) {
    touches[c].is_at_rest = touches[c].is_together = false;
    touches[c].impulse = 0.0;
    real3 x = px - obstacle_offset(c, 0.0), v = pv - correction - velocity_at(obstacle(c), base);
    Gap gap = gap_to(c, radius_of_point, x);
    if (gap.distance > tolerance_at(x) || abs(dot(gap.normal, v)) > quiet_speed(c, 0.0)) continue;
    touches[c].is_at_rest = any = true;
    touches[c].normal = gap.normal;
    touches[c].curvature = gap.curvature;
    touches[c].curved = gap.curved;
  }
  return any;
}

// What leaves a ball ends as in a flight: otherwise the correction of the next step leads back onto it.
void leave_balls() {
  bool on_ball = false, is_loaded = false;
  for (int c = 0; c < COLLIDERS; ++c) {
    if (!touches[c].is_at_rest) continue;
    on_ball = on_ball || touches[c].curvature > 0.0;
    is_loaded = is_loaded || touches[c].impulse > 0.0;
  }
  if (dot(free_correction, pa) > 0.0 && on_ball && !is_loaded) correction = free_correction;
}

// What presses on a ball moves on to its surface, and along it.
void follow_balls(real t) {
  for (int c = 0; c < COLLIDERS; ++c) {
    if (!touches[c].is_at_rest || touches[c].curvature == 0.0 || touches[c].impulse == 0.0) continue;
    real3 ball_v = obstacle_velocity(c, t);
    Gap gap = gap_to(c, radius_of_point, px - obstacle_offset(c, t));
    real moved = left * (norm(pv - ball_v) + left * norm(pa - obstacle(c).acceleration.xyz));
    if (abs(gap.distance) > touches[c].curvature * moved * moved) continue;
    px -= gap.distance * gap.normal;
    pv -= dot(gap.normal, pv - ball_v) * gap.normal;
    correction -= dot(gap.normal, correction - obstacle(c).correction.xyz) * gap.normal;
  }
}

// The time of the next impact.
void predict(int c) {
  touches[c].time = never;
  if (touches[c].is_at_rest) return;
  real3 x = px - obstacle_offset(c, 0.0), v = pv - obstacle_velocity(c, 0.0), a = pa - obstacle(c).acceleration.xyz;
  Gap gap = gap_to(c, radius_of_point, x);
  if (gap.distance > left * (norm(v) + 0.5 * left * norm(a)) + tolerance_at(x)) return;
  real approach = dot(gap.normal, v), quiet = quiet_speed(c, 0.0);
  if (gap.distance <= tolerance_at(x) && approach <= quiet) {
    if (approach < -quiet) touches[c].time = 0.0;
    return;
  }
  touches[c].time = first_impact(c, x, v, a, left);
}

// The speed of approach below which there is no restitution: all bounces then end within the rest of the substep.
real rest_speed(int c, real t, Gap gap, real3 v) {
  real e = colliders[c].spin.w;
  if (e == 0.0) return never;
  real3 along = across(gap.normal, v);
  real pressing = max(real(0.0), -dot(gap.normal, free_acceleration - obstacle(c).acceleration.xyz) - gap.curvature * dot(gap.curved * along, along));
  return max(quiet_speed(c, t), 0.5 * (left - t) * pressing * (1.0 - e) / e);
}

// The impact at a time, with all others at the same time.
void respond(int earliest, real t, bool may_rebound) {
  real fastest = 0.0;
  bool any = false, rebounds = false;
  advance(t);
  for (int n = 0; n < COLLIDERS; ++n) {
    int c = n == 0 ? earliest : n <= earliest ? n - 1 : n;
    touches[c].is_together = false;
    if (n > 0 && (!any || touches[c].time - t > 1e-6 * left)) continue;
    real3 x = px - obstacle_offset(c, t), v = pv - obstacle_velocity(c, t);
    Gap gap = gap_to(c, radius_of_point, x);
    real approach = -dot(gap.normal, v);
    if (approach <= quiet_speed(c, t) || (n > 0 && approach * (touches[c].time - t) > tolerance_at(x))) continue;
    any = true;
    touches[c].is_together = true;
    touches[c].normal = gap.normal;
    touches[c].rebounds = may_rebound && approach > rest_speed(c, t, gap, v);
    rebounds = rebounds || touches[c].rebounds;
    touches[c].min_velocity = touches[c].rebounds ? colliders[c].spin.w * approach : real(0.0);
    touches[c].impulse = 0.0;
    touches[c].friction = real3(0.0);
    touches[c].surface = surface_velocity(c, gap.normal, x);
    fastest = max(fastest, norm(obstacle_velocity(c, t)));
  }
  if (!any) return;
  velocity = pv;
  solve_impulses(false, 1, t, 0.1 * solver_round_off * max(fastest, norm(pv)));
  // drag changes with the velocity (obstacle.h, change_of_drag)
  real passing = substeps.w * (left - t);
  work_of_forces += dot(free_acceleration, px - start_x);
  start_x = px;
  free_acceleration -= substeps.w / (1.0 + 0.5 * passing + passing * passing / 12.0) * (velocity - pv);
  if (rebounds) displaced += (left - t) * (velocity - pv);
  pv = velocity;
  note_change();
  // without a rebound, the correction of the method's path must not separate them either
  for (int c = 0; c < COLLIDERS; ++c)
    if (touches[c].is_together && !touches[c].rebounds)
      correction -= dot(touches[c].normal, correction - obstacle(c).correction.xyz) * touches[c].normal;
}

// Moves the point out of colliders, each along the normal.
void leave_colliders(real t) {
  bool is_outside = false;
  for (int round = 0; round < 8 && !is_outside; ++round) {
    is_outside = true;
    for (int c = 0; c < COLLIDERS; ++c) {
      real3 x = px - obstacle_offset(c, t);
      Gap gap = gap_to(c, radius_of_point, x);
      if (gap.distance >= -tolerance_at(x)) continue;
      px -= gap.distance * gap.normal;
      is_outside = false;
    }
  }
}

// The whole substep: after each impact, the rest of it counts as one of its own.
void simulate(real h, Free path) {
  real3 change = path.v1 - path.v0;
  px = path.x0;
  pa = free_acceleration = change / h;
  correction = (path.x1 - path.x0) / h - path.v0 - 0.5 * change;
  if (norm(correction) <= 4.0 * epsilon * norm(path.x0) / h) correction = real3(0.0);
  free_correction = correction;
  pv = start_v = path.v0 + correction;
  velocity_change = norm(change);
  path_time = base = 0.0;
  left = h;
  leave_colliders(0.0);
  start_x = px;
  is_changed = px != path.x0;
  pushed = -dot(free_acceleration, start_x - path.x0);
  work_of_forces = 0.0;

  for (int impacts = 0;; ++impacts) {
    is_listed = false;
    if (find_resting()) rest();
    leave_balls();
    int earliest = -1;
    for (int c = 0; c < COLLIDERS; ++c) {
      predict(c);
      if (touches[c].time <= left && (earliest < 0 || touches[c].time < touches[earliest].time)) earliest = c;
    }
    if (earliest < 0 || impacts > 2 * max_impacts) break;
    real t = touches[earliest].time;
    respond(earliest, t, impacts < max_impacts);
    follow_balls(t);
    path_time = 0.0;
    base += t;
    left -= t;
    pa = free_acceleration;
  }
  advance(left);
  follow_balls(left);
  leave_colliders(left);
}

#if WORKS
// The speed of the surface, at most.
real surface_speed(int c, real3 x, real h) {
  Obstacle o = obstacle(c);
  real3 spin = colliders[c].first.w == 2.0 ? real3(0.0) : colliders[c].spin.xyz;
  return max(norm(velocity_at(o, 0.0)), norm(velocity_at(o, h))) + norm(o.correction.xyz) + norm(colliders[c].belt.xyz) +
         norm(spin) * norm(x - o.offset.xyz - colliders[c].first.xyz);
}

// `work`: of contact, `pushed`: out of colliders, against the force; both per mass.
void add_works(int i, real work, real pushed, real3 v, Free path) {
  real speed = 0.0, mass = 1.0 / from[i].w, impulse = mass * norm(v - path.v1);
  for (int c = 0; c < COLLIDERS; ++c) speed = max(speed, surface_speed(c, path.x0, substeps.x));
  works[i].of_contact += real4(mass * work, impulse * speed, impulse, mass * pushed);
}
#endif

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= points) return;
  to[2 * points + i] = real4(0.0);  // by which impacts displace it
  if (from[i].w == 0.0) return;
  Free path = Free(from[i].xyz, from[points + i].xyz, to[i].xyz, to[points + i].xyz);
  real h = substeps.x;
  radius_of_point = radius[i];
  int count = 0, only = 0;
  for (int c = 0; c < COLLIDERS; ++c)
    if (!is_clear(c, h, radius_of_point, path)) {
      ++count;
      only = c;
    }
  if (count == 0 || !(norm(path.x0) < never && norm(path.v1) < never)) return;
  real3 x, v;
  real work;
  pushed = 0.0;
  displaced = real3(0.0);
  if (count != 1 || !solve_resting(only, h, radius_of_point, path, x, v, work)) {
    simulate(h, path);
    if (!is_changed) return;
    x = px;
    v = pv - correction;
    work = 0.5 * (dot(pv, pv) - dot(start_v, start_v)) - work_of_forces - dot(free_acceleration, px - start_x);
  }
#if FLAT
  x.z = v.z = 0.0;
#endif
  to[i].xyz = x;
  to[points + i].xyz = v;
  bool has_impact = displaced != real3(0.0);
  to[2 * points + i].xyz = displaced;
#if WORKS
  add_works(i, work, pushed, v, path);
#endif
  atomicOr(events[substep], has_impact ? 5u : 1u);
}
