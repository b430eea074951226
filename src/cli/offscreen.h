// An OpenGL context that needs no window, no display and no GPU.
#pragma once

#include <memory>
#include <string>

namespace hooke {

// Current from its making to its end; one at a time.
class Offscreen {
 public:
  // Makes a context and loads its entry points. Throws std::runtime_error with one line that says what is missing.
  Offscreen();
  ~Offscreen();
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace hooke
