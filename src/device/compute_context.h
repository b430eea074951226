// A context of OpenGL 4.3 without a window: of a graphics card, or else of the software renderer of Mesa. Their libraries are opened when
// they are needed, so that programs start without them.
#pragma once

#include <functional>
#include <string>

#include "device/gl_functions.h"

namespace hooke {

class ComputeContext {
 public:
  // Throws std::runtime_error with one line that says what is missing.
  ComputeContext();
  ~ComputeContext();
  ComputeContext(const ComputeContext&) = delete;
  ComputeContext& operator=(const ComputeContext&) = delete;

  // Calls `work` on a thread of its own, with the context current: that of the calling thread, if it draws, stays as it is.
  void run(const std::function<void(const GlFunctions& gl)>& work);
  // "NVIDIA ..., OpenGL 4.6.0 ..."
  const std::string& renderer() const { return renderer_; }

  // A context of EGL or OSMesa.
  struct Handle {
    std::function<bool(bool on)> make_current;  // for the calling thread; if not `on`, none
    std::function<void*(const char* function)> find;
    std::function<void()> destroy;
  };

 private:
  bool take(const Handle& handle);

  Handle handle_;
  GlFunctions gl_;
  std::string renderer_;
};

}  // namespace hooke
