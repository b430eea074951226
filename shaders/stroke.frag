#version 330 core
// The fraction of the pixel that the line covers; a line thinner than a pixel is fainter, but never broken.
flat in vec4 color;
flat in float half_width;
in float across;
out vec4 result;

void main() {
  float cover = clamp(half_width + 0.5 - abs(across), 0.0, min(1.0, 2.0 * half_width));
  if (cover * color.a < 0.02) discard;
  result = vec4(color.rgb, color.a * cover);
}
