#version 330 core
// Cloth: light from the upper left that wraps slightly around folds, ambient light, more of it from above, and a sheen at grazing angles. A
// normal belongs to the side from which the corners are counter-clockwise; the other side is darker.
in vec3 normal;
in vec2 print;
in vec4 color;
uniform sampler2D picture;
uniform bool is_printed;
out vec4 result;

const vec3 light = vec3(-0.42, 0.66, 0.62);

vec3 shade(vec3 up, vec3 tone, float side) {
  float around = 0.44 + 0.13 * up.y;
  float direct = 0.60 * max((dot(up, light) + 0.3) / 1.3, 0.0);
  float edge = 1.0 - clamp(up.z, 0.0, 1.0);
  return side * (tone * (around + direct) + 0.10 * edge * edge * edge);
}

void main() {
  vec3 up = normalize(normal);
  vec3 tone = is_printed ? color.rgb * texture(picture, print).rgb : color.rgb;
  // at silhouettes and folds, slivers of triangles face away where the smooth surface does not yet: they continue it
  float front = gl_FrontFacing ? 1.0 : smoothstep(-0.35, 0.0, up.z);
  result = vec4(mix(shade(-up, tone, 0.80), shade(up, tone, 1.0), front), color.a);
}
