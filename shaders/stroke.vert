#version 330 core
// A corner of the quad of a line, positioned in pixels.
layout(location = 0) in vec3 place;  // [px], [px], depth
layout(location = 1) in vec4 ink;
layout(location = 2) in vec2 width;  // across, half width [px / 256]
uniform vec2 picture;                // [px]
flat out vec4 color;
flat out float half_width;
out float across;

void main() {
  color = ink;
  across = width.x / 256.0;
  half_width = width.y / 256.0;
  gl_Position = vec4(2.0 * place.xy / picture - 1.0, place.z, 1.0);
}
