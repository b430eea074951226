// The springs of a point. With DASHPOTS, theirs act on the velocities that begin at `acting`.

real3 dashpot_force;  // [N], of all dashpots on the point

real3 spring_force(real3 x, real3 v, ivec2 neighbor) {
  Spring spring = springs[neighbor.y];
  real3 along = x - from[neighbor.x].xyz;
  real square = dot(along, along);
  if (square == 0.0) return real3(0.0);
  real len = sqrt(square);
  real extension = len - spring.rest_length;
  if (spring.only_pulls != 0.0 && !(extension > 0.0)) return real3(0.0);
  real tension = spring.stiffness * extension;
#if DASHPOTS
  real damping = spring.damping * dot(along, v - from[acting + neighbor.x].xyz) / len;
  tension += damping;
  dashpot_force -= damping / len * along;
#endif
  return -tension / len * along;
}

#if GRID
// The spring of a cell: along the row, down, or on one of both diagonals (src/sim/plan/grid.h).
int spring_of(int direction, int row, int column) {
  return (direction * STORED_ROWS + (STORED_ROWS == 1 ? 0 : row)) * COLUMNS + column;
}

real3 springs_force(int i, real3 x, real3 v) {
  int row = i / COLUMNS, column = i % COLUMNS;
  bool up = row > 0, down = row + 1 < ROWS, left = column > 0, right = column + 1 < COLUMNS;
  real3 force = real3(0.0);
  if (right) force += spring_force(x, v, ivec2(i + 1, spring_of(0, row, column)));
  if (left) force += spring_force(x, v, ivec2(i - 1, spring_of(0, row, column - 1)));
  if (down) force += spring_force(x, v, ivec2(i + COLUMNS, spring_of(1, row, column)));
  if (up) force += spring_force(x, v, ivec2(i - COLUMNS, spring_of(1, row - 1, column)));
  if (down && right) force += spring_force(x, v, ivec2(i + COLUMNS + 1, spring_of(2, row, column)));
  if (up && left) force += spring_force(x, v, ivec2(i - COLUMNS - 1, spring_of(2, row - 1, column - 1)));
  if (down && left) force += spring_force(x, v, ivec2(i + COLUMNS - 1, spring_of(3, row, column - 1)));
  if (up && right) force += spring_force(x, v, ivec2(i - COLUMNS + 1, spring_of(3, row - 1, column)));
  return force;
}
#else
real3 springs_force(int i, real3 x, real3 v) {
  real3 force = real3(0.0);
  for (int n = first_neighbor[i]; n < first_neighbor[i + 1]; ++n) force += spring_force(x, v, neighbors[n]);
  return force;
}
#endif
