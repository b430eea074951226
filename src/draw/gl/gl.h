// RAII for OpenGL objects. The rest of draw uses GLEW through this header only.
#pragma once

#include <GL/glew.h>

#include <utility>

namespace hooke {

enum class GlKind { Buffer, VertexArray, Texture, Renderbuffer, Framebuffer, Program };

// Owns one object. Its context must be current at construction and destruction.
class GlName {
 public:
  GlName() = default;
  explicit GlName(GlKind kind);
  ~GlName();
  GlName(GlName&& other) noexcept : kind_(other.kind_), name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(kind_, other.kind_);
    std::swap(name_, other.name_);
    return *this;
  }
  operator GLuint() const { return name_; }

 private:
  GlKind kind_ = GlKind::Buffer;
  GLuint name_ = 0;
};

}  // namespace hooke
