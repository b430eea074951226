#version 330 core
// A corner of a face of a cloth.
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 normal_seen;  // in view coordinates
layout(location = 2) in vec2 place;        // texture coordinates, 1 is the width and height of the texture
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
