#version 330 core
// A vertex of the panels, in screen units from the upper left corner.
layout(location = 0) in vec2 place;
layout(location = 1) in vec2 texel;
layout(location = 2) in vec4 ink;
uniform vec4 display;  // left, top, width, height
out vec2 at;
out vec4 color;

void main() {
  at = texel;
  color = ink;
  vec2 fraction = (place - display.xy) / display.zw;
  gl_Position = vec4(2.0 * fraction.x - 1.0, 1.0 - 2.0 * fraction.y, 0.0, 1.0);
}
