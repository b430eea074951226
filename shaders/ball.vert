#version 330 core
// A corner of the quad that covers a sphere.
layout(location = 0) in vec4 clip;
layout(location = 1) in vec3 place_seen;  // [m], relative to the eye
layout(location = 2) in vec4 sphere;      // center and radius [m]
layout(location = 3) in vec4 ink;
layout(location = 4) in vec3 axis_seen;      // unit; zero: no rotation
layout(location = 5) in vec3 meridian_seen;  // unit
layout(location = 6) in vec4 map_place;      // corner [m], 1 / size [1/m]
layout(location = 7) in vec4 map_texels;     // position and size in the atlas of all maps; no size: no shadow
out vec3 place;
flat out vec4 ball;
flat out vec4 color;
flat out vec3 axis;
flat out vec3 meridian;
flat out vec4 map;
flat out vec4 texels;

void main() {
  place = place_seen;
  ball = sphere;
  color = ink;
  axis = axis_seen;
  meridian = meridian_seen;
  map = map_place;
  texels = map_texels;
  gl_Position = clip;
}
