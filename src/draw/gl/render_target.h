// The framebuffers that a picture is drawn to. They are the same in a window and off screen, so that both give the same pixels.
#pragma once

#include "draw/gl/gl.h"
#include "draw/pixel_box.h"
#include "draw/view.h"

namespace hooke {

class RenderTarget {
 public:
  // Resizes the picture and binds it. Throws std::runtime_error if no framebuffer of this size can be created.
  void begin(int width, int height);
  // Binds a multisampled framebuffer of the same size, with fewer samples if the driver supports fewer. False: none is available, and the
  // picture stays bound.
  bool begin_multisampled(int samples);
  // Resolves the samples of this part to colors and depths of the picture, and binds the picture.
  void resolve(const PixelBox& part) const;
  void show() const;
  Image read(bool with_opacity) const;

 private:
  // A framebuffer with color and depth.
  struct Layer {
    GlName frame, color, depth;
    int width = 0, height = 0, samples = 0;
    bool fits(int wanted_width, int wanted_height) const { return width == wanted_width && height == wanted_height; }
    bool allocate(int new_width, int new_height, int new_samples);
  };
  void allocate_sampled(int samples);

  Layer picture_, sampled_;
  int asked_ = 0;  // samples requested when sampled_ was allocated
};

}  // namespace hooke
