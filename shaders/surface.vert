#version 330 core
// A corner of a lit triangle.
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 normal_seen;  // in view coordinates; zero: not lit
layout(location = 2) in vec4 ink;
out vec3 normal;
out vec4 color;

void main() {
  normal = normal_seen.xyz;
  color = ink;
  gl_Position = clip;
}
