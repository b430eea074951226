#include "draw/gl/gl.h"

#include <malloc.h>

#include "draw/view.h"

namespace hooke {
namespace {

// The software renderer (llvmpipe) frees the memory of each picture. Unless malloc keeps it, the next picture waits for
// pages from the kernel: 26 ms instead of 16 for a cloth of 64 x 64.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
#endif
}

// In the order of GlKind.
constexpr struct {
  void (*create)(GLuint& name);
  void (*destroy)(GLuint name);
} functions[] = {
    {[](GLuint& name) { glGenBuffers(1, &name); }, [](GLuint name) { glDeleteBuffers(1, &name); }},
    {[](GLuint& name) { glGenVertexArrays(1, &name); }, [](GLuint name) { glDeleteVertexArrays(1, &name); }},
    {[](GLuint& name) { glGenTextures(1, &name); }, [](GLuint name) { glDeleteTextures(1, &name); }},
    {[](GLuint& name) { glGenRenderbuffers(1, &name); }, [](GLuint name) { glDeleteRenderbuffers(1, &name); }},
    {[](GLuint& name) { glGenFramebuffers(1, &name); }, [](GLuint name) { glDeleteFramebuffers(1, &name); }},
    {[](GLuint& name) { name = glCreateProgram(); }, [](GLuint name) { glDeleteProgram(name); }},
};

}  // namespace

GlName::GlName(GlKind kind) : kind_(kind) { functions[static_cast<std::size_t>(kind)].create(name_); }

GlName::~GlName() {
  if (name_ != 0) functions[static_cast<std::size_t>(kind_)].destroy(name_);
}

std::string load_gl() {
  if (glGetString(GL_VERSION) == nullptr) return "OpenGL: no context is current, or the program was linked against another OpenGL library";
  glewExperimental = GL_TRUE;
  const GLenum status = glewInit();

  // 4 is GLEW_ERROR_NO_GLX_DISPLAY (Wayland, EGL, OSMesa), 3 a similar error: the functions are loaded nevertheless.
  if (status != GLEW_OK && status != 3 && status != 4)
    return "OpenGL: " + std::string(reinterpret_cast<const char*>(glewGetErrorString(status)));
  keep_freed_memory();
  while (glGetError() != GL_NO_ERROR) continue;
  if (!GLEW_VERSION_3_3)
    return "OpenGL: version 3.3 is required, but this is " + std::string(reinterpret_cast<const char*>(glGetString(GL_VERSION)));
  return {};
}

}  // namespace hooke
