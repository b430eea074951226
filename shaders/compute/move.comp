// Forces at the positions, a kick of the velocities, and a drift: one thread for each point, which sums the forces of its own springs in a
// fixed order.

#if PULL
// The hand's spring acts on the weighted mean of the pulled points.
real3 pull_stretch() {
  real3 stretch = -moments[moment].target.xyz;
  for (int p = 0; p < 3; ++p) stretch += pull[p] * from[pulled[p]].xyz;
  return stretch;
}

real3 pull_force(int i) {
  real3 stretch = pull_stretch(), force = real3(0.0);
  for (int p = 0; p < 3; ++p)
    if (pulled[p] == i) force -= pull.w * pull[p] * stretch;
  return force;
}
#endif

#if WIND
// The force of the air on each corner of a panel (src/sim/forces/terms/wind.cpp).
real3 panel_force(ivec4 panel) {
  bool is_quad = panel.w >= 0;
  real3 a = from[panel.x].xyz, b = from[panel.y].xyz, c = from[panel.z].xyz;
  real3 velocity = from[acting + panel.x].xyz + from[acting + panel.y].xyz + from[acting + panel.z].xyz;
  if (is_quad) velocity += from[acting + panel.w].xyz;
  real corners = is_quad ? 4.0 : 3.0;
  real3 twice_area = is_quad ? cross(c - a, from[panel.w].xyz - b) : cross(b - a, c - a);
  real square = dot(twice_area, twice_area);
  if (!(square > 0.0)) return real3(0.0);
  real3 past = moments[moment].wind.xyz - velocity / corners;
  real flux = dot(past, twice_area), across = flux / square;
  real3 along = past - across * twice_area;
  real of_normal = air.x / (2.0 * corners) * abs(flux) * across;
  real of_tangential = air.y / (2.0 * corners) * sqrt(square * dot(along, along));
  return of_normal * twice_area + of_tangential * along;
}

real3 wind_force(int i, real3 v) {
  real3 force = real3(0.0);
#if WIND == 2
  // a scene without faces: on each point
  real3 past = moments[moment].wind.xyz - v;
  force = air.x * PI * radius[i] * radius[i] * sqrt(dot(past, past)) * past;
#else
  for (int p = first_panel[i]; p < first_panel[i + 1]; ++p) force += panel_force(panels[panel_of[p]]);
#endif
  return force;
}
#endif

// `power`: of wind and dashpots.
real3 acceleration_of(int i, real4 x, real3 v, out real4 power) {
  dashpot_force = real3(0.0);
  real3 force = springs_force(i, x.xyz, v);
  power = real4(0.0, dot(dashpot_force, v), 0.0, 0.0);
#if PULL
  force += pull_force(i);
#endif
#if WIND
  real3 of_wind = wind_force(i, v);
  force += of_wind;
  power.x = dot(of_wind, v);
#endif
  return acceleration.xyz + x.w * force;
}

#if WORKS
// Of drag, what the kick takes more than the force a does; of wind and dashpots by their power, which an unstable step does not reverse.
void add_works(int i, Pass by, real4 x, real3 v, real3 a, real4 power) {
  real3 taken = (by.decay - 1.0) * v + (by.weight - by.duration) * a, mean = 0.5 * ((by.decay + 1.0) * v + by.weight * a);
  works[i].of_forces += real4(0.0, by.duration * power.x, dot(mean, taken) / x.w, by.duration * power.y);
}

// Of the hand where it moves the end of its spring, or a point against springs, dashpots and weight (src/sim/forces/hand.cpp).
void add_work_of_hand(int i, real duration, real3 x, real3 v) {
#if PULL
  if (i == pulled[0]) works[i].of_forces.x -= duration * pull.w * dot(pull_stretch(), pull_velocity.xyz);
#endif
  if (i != int(held.w)) return;
  dashpot_force = real3(0.0);
  real3 force = springs_force(i, x, v) + held.xyz;
  works[i].of_forces += duration * real4(-dot(force, v), 0.0, 0.0, dot(dashpot_force, v));
}
#endif

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= points) return;
  real4 x = from[i], v = from[points + i], predicted = v;
  Pass by = passes[pass];
  if (x.w != 0.0) {
    bool is_known = reused >= 0 && events[reused] == 0u;
    real4 power;
    real3 a = is_known ? accelerations[i].xyz : acceleration_of(i, x, from[acting + i].xyz, power);
    accelerations[i].xyz = a;
#if WORKS
    if (is_known) power = works[i].power;
    works[i].power = power;
    add_works(i, by, x, v.xyz, a, power);
#endif
    v.xyz = by.decay * v.xyz + by.weight * a;
    predicted.xyz = by.ahead_decay * v.xyz + by.ahead_weight * a;
  }
#if WORKS
  add_work_of_hand(i, by.duration, x.xyz, v.xyz);
#endif
  x.xyz += by.drift * v.xyz;
  to[i] = x;
  to[points + i] = v;
  to[2 * points + i] = predicted;
}
