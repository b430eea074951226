// An OpenGL context that needs no window, no display and no GPU.
#pragma once

#include <memory>

namespace hooke {

// The current context as long as it exists; one at a time.
class Offscreen {
 public:
  // Creates a context and loads its entry points. Throws std::runtime_error with one line that names what is missing.
  Offscreen();
  ~Offscreen();
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace hooke
