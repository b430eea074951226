#version 330 core
// Flat shading, the same from both sides: a normal belongs to the side from which the corners are counter-clockwise.
in vec3 normal;
in vec4 color;
out vec4 result;

const vec3 light = vec3(-0.42, 0.66, 0.62);

void main() {
  float size = length(normal);
  float facing = dot(normal, light) / max(size, 1e-3) * (gl_FrontFacing ? 1.0 : -1.0);
  float lit = size < 0.1 ? 1.0 : 0.60 + 0.52 * facing;
  result = vec4(color.rgb * lit, color.a);
}
