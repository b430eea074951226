// Draws many small shapes in one call. Vertices are rewritten in each frame and uploaded once.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>

#include "draw/gl/gl.h"

namespace hooke {

// One input of a vertex shader, by its offset in the vertex; locations count from 0.
struct Attribute {
  GLint components;
  GLenum type;
  GLboolean normalized;
  std::size_t offset;
};

// The buffers of a batch: of quads, four vertices each (0 1 2 and 2 1 3), or of triangles by their indices; not both.
class VertexStream {
 public:
  VertexStream(std::initializer_list<Attribute> attributes, std::size_t stride);
  void draw_quads(const void* vertices, std::size_t count);
  void draw_indexed(const void* vertices, std::size_t count, std::span<const GLuint> indices);

 private:
  void upload(const void* vertices, std::size_t count);

  std::size_t stride_;
  std::size_t quads_ = 0;  // that the index buffer has space for
  GlName array_{GlKind::VertexArray}, vertices_{GlKind::Buffer}, indices_{GlKind::Buffer};
};

}  // namespace hooke
