#include "draw/gl/vertex_stream.h"

#include <bit>

namespace hooke {

VertexStream::VertexStream(std::initializer_list<Attribute> attributes, std::size_t stride) : stride_(stride) {
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  GLuint location = 0;
  for (const Attribute& attribute : attributes) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, attribute.components, attribute.type, attribute.normalized, static_cast<GLsizei>(stride),
                          reinterpret_cast<const void*>(attribute.offset));
    ++location;
  }
}

void VertexStream::upload(const void* vertices, std::size_t count) {
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  // Reallocate in each frame: the GPU may still be reading the old buffer.
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * stride_), vertices, GL_STREAM_DRAW);
}

void VertexStream::draw_quads(const void* vertices, std::size_t count) {
  if (count == 0) return;
  upload(vertices, count);

  const std::size_t quads = count / 4;
  if (quads > quads_) {
    quads_ = std::bit_ceil(quads);
    std::vector<GLuint> indices;
    indices.reserve(6 * quads_);
    for (GLuint first = 0; first < 4 * quads_; first += 4)
      for (const GLuint corner : {0u, 1u, 2u, 2u, 1u, 3u}) indices.push_back(first + corner);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(GLuint)), indices.data(), GL_STATIC_DRAW);
  }
  glDrawRangeElements(GL_TRIANGLES, 0, static_cast<GLuint>(count - 1), static_cast<GLsizei>(6 * quads), GL_UNSIGNED_INT, nullptr);
}

void VertexStream::draw_indexed(const void* vertices, std::size_t count, std::span<const GLuint> indices) {
  if (indices.empty()) return;
  upload(vertices, count);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size_bytes()), indices.data(), GL_STREAM_DRAW);
  glDrawRangeElements(GL_TRIANGLES, 0, static_cast<GLuint>(count - 1), static_cast<GLsizei>(indices.size()), GL_UNSIGNED_INT, nullptr);
}

}  // namespace hooke
