#version 330 core
// A corner of a shadow on something flat.
layout(location = 0) in vec4 clip;
layout(location = 1) in vec2 texel;  // in the picture of all maps
layout(location = 2) in vec2 middle; // from the middle of the ground, 1 at its border
out vec2 place;
out vec2 fade;

void main() {
  place = texel;
  fade = middle;
  gl_Position = clip;
}
