#version 330 core
// A corner of a shadow on a flat surface.
layout(location = 0) in vec4 clip;
layout(location = 1) in vec2 texel;  // in the atlas of all maps
layout(location = 2) in vec2 middle; // relative to the center of the ground, 1 at its border
out vec2 place;
out vec2 fade;

void main() {
  place = texel;
  fade = middle;
  gl_Position = clip;
}
