// Shader programs, from the sources in shaders/, which the build embeds.
#pragma once

#include <span>
#include <string_view>

#include "draw/gl/gl.h"

namespace hooke {

// A .vert and .frag pair by its file name without extension. Generated (cmake/embed_shaders.cmake).
struct ShaderSource {
  std::string_view name, vertex, fragment;
};
std::span<const ShaderSource> shader_sources();

class Shader {
 public:
  // Compiles and links the pair of this name. Throws std::logic_error with the log if that fails.
  explicit Shader(std::string_view name);
  void use() const { glUseProgram(program_); }
  GLint uniform(const char* name) const { return glGetUniformLocation(program_, name); }

 private:
  GlName program_;
};

}  // namespace hooke
