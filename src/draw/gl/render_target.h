// Where the picture comes into being: framebuffers of our own, the same in a window and off screen, so that both give
// the same pixels.
#pragma once

#include "draw/gl/gl.h"
#include "draw/view.h"

namespace hooke {

class RenderTarget {
 public:
  // Makes the framebuffers fit and binds the one to begin with: of several samples a pixel, if asked for; fewer where
  // the driver has no more. Throws std::runtime_error when it can give no framebuffer of this size.
  void begin(int width, int height, int samples);
  // Polygons are done: their samples become the picture's colours and depths, and what follows is drawn onto the
  // picture itself. Lines, points and panels are smooth by themselves; sampling them would cost three times as much.
  void resolve() const;
  void show() const;
  Image read() const;

 private:
  // A framebuffer with colour and depth.
  struct Layer {
    GlName frame, color, depth;
    int width = 0, height = 0, samples = 0;
    bool fits(int wanted_width, int wanted_height) const { return width == wanted_width && height == wanted_height; }
    bool allocate(int new_width, int new_height, int new_samples);
  };
  void allocate_sampled(int samples);

  Layer picture_, sampled_;
  int asked_ = 0;          // samples that sampled_ was made for
  bool sampling_ = false;  // this picture began in sampled_
};

}  // namespace hooke
