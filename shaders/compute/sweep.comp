// Dashpots that share no point, each solved exactly over half a substep (src/sim/forces/dashpots/dashpot.cpp): one thread for each. In
// `from`, in place.
struct Sweep {
  real i, j;  // points
  real loss;  // [kg], impulse per relative speed
  real spring;
};
layout(std430, binding = 16) buffer Sweeps { Sweep sweeps[]; };

void main() {
  int n = first + int(gl_GlobalInvocationID.x);
  if (n >= end) return;
  int i = int(sweeps[n].i), j = int(sweeps[n].j);
  real3 along = from[i].xyz - from[j].xyz;
  real square = dot(along, along);
  if (!(square > 0.0)) return;
#if !GRID
  Spring spring = springs[int(sweeps[n].spring)];
  bool is_slack = spring.only_pulls != 0.0 && !(sqrt(square) > spring.rest_length);
  if (spring.damping == 0.0 || is_slack) return;  // broken, or a cable
#endif
  real3 vi = from[points + i].xyz, vj = from[points + j].xyz;
  real impulse = sweeps[n].loss / square * dot(along, vi - vj);
  from[points + i].xyz -= from[i].w * impulse * along;
  from[points + j].xyz += from[j].w * impulse * along;
#if WORKS
  // at the mean speed
  real inverse_mass = from[i].w + from[j].w;
  works[i].of_forces.w -= impulse * (dot(along, vi - vj) - 0.5 * inverse_mass * impulse * square);
  if (i == int(held.w)) works[i].of_forces.x += impulse * dot(along, vi);
  if (j == int(held.w)) works[j].of_forces.x -= impulse * dot(along, vj);
#endif
}
