#version 330 core
// A corner of a plane.
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 place;  // in cells of the finer grid; relative to the center, 1 at the border
layout(location = 2) in float fine_share;
layout(location = 3) in vec4 fill_ink;
layout(location = 4) in vec4 line_ink;
out vec2 cell;
out vec2 fade;
flat out float fine;
flat out vec4 fill;
flat out vec4 line;

void main() {
  cell = place.xy;
  fade = place.zw;
  fine = fine_share;
  fill = fill_ink;
  line = line_ink;
  gl_Position = clip;
}
