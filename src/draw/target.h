// Where the picture comes into being: a framebuffer of our own, multisampled, and the finished picture beside it. The
// same in a window and off screen, so that both give the same pixels.
#pragma once

#include "draw/gl.h"
#include "draw/view.h"

namespace hooke {

class Target {
 public:
  // Makes the framebuffers fit and binds the one to draw the scene into. Fewer samples than asked for where the driver
  // has no more. Throws std::runtime_error when it can give no framebuffer of this size.
  void begin(int width, int height, int samples);
  // The scene is done: its samples become the picture's pixels; what follows is drawn onto the picture itself.
  void resolve() const;
  void show() const;
  Image read() const;

 private:
  void resize(int width, int height, int samples);
  bool allocate(int samples);

  int width_ = 0, height_ = 0;
  int asked_ = -1, samples_ = 0;
  GlName color_, depth_, sampled_color_;  // renderbuffers
  GlName picture_, sampled_;              // framebuffers; sampled_ is unused without multisampling
};

}  // namespace hooke
