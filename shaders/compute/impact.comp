// The impulses of the dashpots of points that impacts have displaced (src/sim/contact/contact.cpp, damp_impacts): one thread for each point.
// `acting`: where contact.comp has left the displacements, in `from`, in which the velocities change.

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= points || from[i].w == 0.0 || (events[substep] & 4u) == 0u) return;
  dashpot_force = real3(0.0);
  springs_force(i, from[i].xyz, from[acting + i].xyz);
  real3 change = from[i].w / (1.0 + substeps.x * substeps.z) * dashpot_force, v = from[points + i].xyz;
  from[points + i].xyz = v + change;
#if WORKS
  works[i].of_forces.w += dot(v + 0.5 * change, change) / from[i].w;
#endif
}
