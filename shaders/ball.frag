#version 330 core
// Casts a ray against a sphere: its nearest intersection, lit, with an antialiased edge; sectors that rotate with it; the shadow of objects
// above it.
in vec3 place;
flat in vec4 ball;
flat in vec4 color;
flat in vec3 axis;
flat in vec3 meridian;
flat in vec4 map;
flat in vec4 texels;
uniform vec2 depth;         // of the projection: clip z = depth.x z + depth.y
uniform bool orthographic;
uniform mat3 from_above;    // columns: the axes across, along and up the pole, in view coordinates
uniform sampler2D maps;
uniform vec4 shadow;
out vec4 result;

const vec3 light = vec3(-0.42, 0.66, 0.62);

void main() {
  vec3 origin = orthographic ? vec3(place.xy, 0.0) : vec3(0.0);
  vec3 along = orthographic ? vec3(0.0, 0.0, -1.0) : normalize(place);

  // the point of the ray nearest to the center, and the distance from there to the surface
  float nearest = dot(ball.xyz - origin, along);
  float miss = length(origin + nearest * along - ball.xyz);
  float cover = clamp((ball.w - miss) / max(fwidth(miss), 1e-12) + 0.5, 0.0, 1.0);
  if (cover < 0.02) discard;
  float before = sqrt(max(ball.w * ball.w - miss * miss, 0.0));
  vec3 hit = origin + (nearest - before) * along;

  vec3 normal = (hit - ball.xyz) / ball.w;
  float lit = 0.62 + 0.42 * dot(normal, light);
  vec3 tone = color.rgb * lit;

  // three dark sectors and three light ones; near the poles, where they become too narrow, their mean
  if (dot(axis, axis) > 0.5) {
    float wave = sin(3.0 * atan(dot(normal, cross(axis, meridian)), dot(normal, meridian)));
    tone *= mix(0.84, 1.10, clamp(wave / max(fwidth(wave), 1e-4) + 0.5, 0.0, 1.0));
  }

  // the shadow comes from above and ends where the surface faces down
  if (texels.z > 0.0) {
    vec3 above = (hit - ball.xyz) * from_above;
    vec2 at = clamp((above.xy - map.xy) * map.zw, 0.0, 1.0);
    float shade = texture(maps, texels.xy + at * texels.zw).r * smoothstep(0.0, 0.8, above.z / ball.w);
    tone = mix(tone, shadow.rgb, shadow.a * shade);
  }
  result = vec4(tone, color.a * cover);
  float clip = depth.x * hit.z + depth.y;
  gl_FragDepth = 0.5 * (orthographic ? clip : clip / -hit.z) + 0.5;
}
