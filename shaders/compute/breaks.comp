// Springs that are as long as they may be break at the end of a substep: one thread for each spring.
layout(std430, binding = 13) buffer Ends { ivec2 ends[]; };  // points
struct Limit {
  real max;     // [m], the length at which it breaks
  real broken;  // [m], the length at which it did; 0: it did not
};
layout(std430, binding = 14) buffer Limits { Limit limits[]; };

void main() {
  int s = int(gl_GlobalInvocationID.x);
  if (s >= limits.length()) return;
  if (springs[s].stiffness == 0.0 && springs[s].damping == 0.0) return;
  real3 along = from[ends[s].x].xyz - from[ends[s].y].xyz;
  real len = sqrt(dot(along, along));
  if (!(len >= limits[s].max)) return;
  springs[s].stiffness = 0.0;
  springs[s].damping = 0.0;
  limits[s].broken = len;
  atomicOr(events[substep], 2u);
}
