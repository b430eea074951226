#version 330 core
// A lit sphere (or a square plate for a nailed point) with its ring and antialiased edges; depth follows the sphere.
in vec2 offset;             // [px] from the center
flat in vec2 radii;         // [px], of the body and of the outer edge of the ring (0: none)
flat in vec2 depths;        // of the center and the front, in 0..1
flat in vec4 body;
flat in vec4 ring;
flat in float is_square;
uniform float ring_width;   // [px]
out vec4 result;

const vec3 light = vec3(-0.42, 0.66, 0.62);

void main() {
  float radius = radii.x;
  float from_center = length(offset);
  vec2 away = abs(offset);
  float edge = is_square > 0.5 ? max(away.x, away.y) - 0.9 * radius : from_center - radius;  // [px], negative inside
  float inside = clamp(0.5 - edge, 0.0, 1.0);

  vec2 slope = offset / max(max(radius, from_center), 0.5);
  float bulge = is_square > 0.5 ? 0.8 : sqrt(max(1.0 - dot(slope, slope), 0.0));
  vec3 normal = is_square > 0.5 ? normalize(vec3(0.25 * slope, 1.0)) : vec3(slope, bulge);
  float facing = max(dot(normal, light), 0.0);
  // a dark edge makes nails visible on light backgrounds
  float rim = is_square > 0.5 ? clamp(edge + min(0.75 * ring_width, 0.3 * radius) + 0.5, 0.0, 1.0) : 0.0;
  float shine = is_square > 0.5 ? 0.0 : 0.22 * pow(facing, 24.0);
  vec4 color = vec4(body.rgb * (0.66 + 0.34 * facing) * (1.0 - 0.7 * rim) + shine, body.a * inside);

  // the ring on top of the body
  float outer = clamp(radii.y - from_center + 0.5, 0.0, 1.0);
  float inner = clamp(from_center - (radii.y - ring_width) + 0.5, 0.0, 1.0);
  float cover = radii.y > 0.0 ? outer * inner * ring.a : 0.0;
  float opacity = cover + color.a * (1.0 - cover);
  color = vec4(mix(color.rgb * color.a, ring.rgb, cover) / max(opacity, 1e-3), opacity);
  if (color.a < 0.02) discard;
  result = color;
  gl_FragDepth = mix(depths.x, depths.y, max(bulge, cover));
}
