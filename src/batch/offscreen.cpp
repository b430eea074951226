#include "batch/offscreen.h"

#include <GL/osmesa.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "draw/view.h"

// GLEW, built for GLX, looks up every entry point with this function; a program that links OSMesa instead of libGL looks it up there.
// So it is exported. OSMesa returns stubs for glX names, which must not be called: they are reported as missing.
extern "C" __attribute__((visibility("default"))) void (*glXGetProcAddressARB(const GLubyte* name))() {
  const auto* text = reinterpret_cast<const char*>(name);
  return std::strncmp(text, "glX", 3) == 0 ? nullptr : OSMesaGetProcAddress(text);
}

namespace hooke {

// The context's own image is one pixel: everything is drawn into framebuffer objects (draw/gl/render_target.h).
struct Offscreen::Context {
  OSMesaContext name = nullptr;
  std::array<std::uint8_t, 4> pixel{};
  ~Context() {
    OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    if (name) OSMesaDestroyContext(name);
  }
};

Offscreen::Offscreen() : context_(std::make_unique<Context>()) {
  const std::array<int, 11> wanted{OSMESA_FORMAT,
                                   OSMESA_RGBA,
                                   OSMESA_DEPTH_BITS,
                                   24,
                                   OSMESA_PROFILE,
                                   OSMESA_CORE_PROFILE,
                                   OSMESA_CONTEXT_MAJOR_VERSION,
                                   3,
                                   OSMESA_CONTEXT_MINOR_VERSION,
                                   3,
                                   0};
  context_->name = OSMesaCreateContextAttribs(wanted.data(), nullptr);
  if (!context_->name || !OSMesaMakeCurrent(context_->name, context_->pixel.data(), GL_UNSIGNED_BYTE, 1, 1))
    throw std::runtime_error("OSMesa: no OpenGL 3.3 context");
  const std::string error = load_gl();
  if (!error.empty()) throw std::runtime_error(error);
}

Offscreen::~Offscreen() = default;

}  // namespace hooke
