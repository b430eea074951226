#version 330 core
// Panels: plain shapes use a white texel of the font atlas.
in vec2 at;
in vec4 color;
uniform sampler2D font;
out vec4 result;

void main() { result = color * texture(font, at); }
