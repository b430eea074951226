#version 330 core
// A ray against a sphere: its nearest place, lit, with a soft edge.
in vec3 place;
flat in vec4 ball;
flat in vec4 color;
uniform vec2 depth;         // of the projection: clip z = depth.x z + depth.y
uniform bool orthographic;
out vec4 result;

const vec3 light = vec3(-0.42, 0.66, 0.62);

void main() {
  vec3 origin = orthographic ? vec3(place.xy, 0.0) : vec3(0.0);
  vec3 along = orthographic ? vec3(0.0, 0.0, -1.0) : normalize(place);

  // the ray's nearest place to the center, and how far before it the sphere begins
  float nearest = dot(ball.xyz - origin, along);
  float miss = length(origin + nearest * along - ball.xyz);
  float cover = clamp((ball.w - miss) / max(fwidth(miss), 1e-12) + 0.5, 0.0, 1.0);
  if (cover < 0.02) discard;
  float before = sqrt(max(ball.w * ball.w - miss * miss, 0.0));
  vec3 hit = origin + (nearest - before) * along;

  vec3 normal = (hit - ball.xyz) / ball.w;
  float lit = 0.62 + 0.42 * dot(normal, light);
  result = vec4(color.rgb * lit, color.a * cover);
  float clip = depth.x * hit.z + depth.y;
  gl_FragDepth = 0.5 * (orthographic ? clip : clip / -hit.z) + 0.5;
}
