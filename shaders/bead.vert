#version 330 core
// A corner of the quad of a point, positioned in pixels.
layout(location = 0) in vec4 place;   // [px], [px], depth of the center, depth of the front
layout(location = 1) in vec4 extent;  // across, upward, radius, ring [px]
layout(location = 2) in vec4 body_ink;
layout(location = 3) in vec4 ring_ink;
layout(location = 4) in float square;
uniform vec2 picture;                 // [px]
out vec2 offset;
flat out vec2 radii;
flat out vec2 depths;
flat out vec4 body;
flat out vec4 ring;
flat out float is_square;

void main() {
  offset = extent.xy;
  radii = extent.zw;
  depths = 0.5 * place.zw + 0.5;
  body = body_ink;
  ring = ring_ink;
  is_square = square;
  gl_Position = vec4(2.0 * place.xy / picture - 1.0, place.z, 1.0);
}
