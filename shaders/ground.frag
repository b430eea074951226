#version 330 core
// A floor that fades out towards its border, with two grids whose lines are one pixel wide and fade before they would alias.
in vec2 cell;
in vec2 fade;
flat in float fine;
flat in vec4 fill;
flat in vec4 line;
out vec4 result;

// The fraction of a pixel covered by lines at integers; `width` is the size of a pixel in the same unit.
float grid(vec2 at, vec2 width) {
  vec2 away = abs(fract(at - 0.5) - 0.5);
  vec2 cover = clamp(1.0 - away / width, 0.0, 1.0) * clamp(1.0 - 3.0 * width, 0.0, 1.0);
  return max(cover.x, cover.y);
}

void main() {
  float shown = 1.0 - smoothstep(0.2, 1.0, length(fade));
  vec2 width = fwidth(cell);
  float lines = line.a * max(grid(0.1 * cell, 0.1 * width), 0.4 * fine * grid(cell, width));
  float opacity = max(fill.a, lines) * shown;
  if (opacity < 0.01) discard;
  result = vec4(mix(fill.rgb, line.rgb, lines / max(max(fill.a, lines), 0.01)), opacity);
}
