// Sums the works of the points, and forgets them: thread n adds those of the points n, n + `end`, n + 2 `end`, and so on.
layout(std430, binding = 18) buffer Sums { real4 sums[]; };

void main() {
  int n = int(gl_GlobalInvocationID.x);
  if (n >= end) return;
  real4 of_forces = real4(0.0), of_contact = real4(0.0);
  for (int i = n; i < points; i += end) {
    of_forces += works[i].of_forces;
    of_contact += works[i].of_contact;
    works[i].of_forces = works[i].of_contact = real4(0.0);
  }
  sums[2 * n] = of_forces;
  sums[2 * n + 1] = of_contact;
}
