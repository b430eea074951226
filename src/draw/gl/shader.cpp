#include "draw/gl/shader.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hooke {
namespace {

const ShaderSource& find_source(std::string_view name) {
  const auto sources = shader_sources();
  const auto found = std::find_if(sources.begin(), sources.end(), [&](const ShaderSource& source) { return source.name == name; });
  if (found == sources.end()) throw std::logic_error("no shader named " + std::string(name));
  return *found;
}

void attach(GLuint program, GLenum kind, std::string_view text, std::string_view name) {
  const GLuint shader = glCreateShader(kind);
  const GLchar* start = text.data();
  const GLint length = static_cast<GLint>(text.size());
  glShaderSource(shader, 1, &start, &length);
  glCompileShader(shader);
  glAttachShader(program, shader);

  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  std::string log(compiled ? 0 : 4096, '\0');
  if (!compiled) glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  glDeleteShader(shader);  // deleted with the program
  if (!compiled) throw std::logic_error("shader " + std::string(name) + ": " + log.c_str());
}

}  // namespace

Shader::Shader(std::string_view name) : program_(GlKind::Program) {
  const ShaderSource& source = find_source(name);
  attach(program_, GL_VERTEX_SHADER, source.vertex, name);
  attach(program_, GL_FRAGMENT_SHADER, source.fragment, name);
  glLinkProgram(program_);

  GLint linked = GL_FALSE;
  glGetProgramiv(program_, GL_LINK_STATUS, &linked);
  if (linked) return;
  std::string log(4096, '\0');
  glGetProgramInfoLog(program_, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw std::logic_error("shader " + std::string(name) + ": " + log.c_str());
}

}  // namespace hooke
