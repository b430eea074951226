#version 330 core
// Shadow from light above, fading out with the ground.
in vec2 place;
in vec2 fade;
uniform sampler2D maps;
uniform vec4 ink;
out vec4 result;

void main() {
  float shade = ink.a * texture(maps, place).r * (1.0 - smoothstep(0.2, 1.0, length(fade)));
  if (shade < 0.004) discard;
  result = vec4(ink.rgb, shade);
}
