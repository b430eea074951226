#version 330 core
// A corner of a cloth's face.
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 normal_seen;  // as the viewer sees it
layout(location = 2) in vec2 place;        // on the picture, 1 being its width and height
layout(location = 3) in vec4 ink;
out vec3 normal;
out vec2 print;
out vec4 color;

void main() {
  normal = normal_seen.xyz;
  print = place;
  color = ink;
  gl_Position = clip;
}
