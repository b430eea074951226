#version 330 core
// A corner of the quad that covers a sphere.
layout(location = 0) in vec4 clip;
layout(location = 1) in vec3 place_seen;  // [m], the eye in the origin
layout(location = 2) in vec4 sphere;      // center and radius [m]
layout(location = 3) in vec4 ink;
out vec3 place;
flat out vec4 ball;
flat out vec4 color;

void main() {
  place = place_seen;
  ball = sphere;
  color = ink;
  gl_Position = clip;
}
