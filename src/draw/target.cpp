#include "draw/target.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hooke {
namespace {

void store(const GlName& renderbuffer, GLenum format, int width, int height, int samples) {
  glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
}

void attach(GLenum place, const GlName& renderbuffer) { glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, renderbuffer); }

bool is_complete() { return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE && glGetError() == GL_NO_ERROR; }

}  // namespace

void Target::begin(int width, int height, int samples) {
  if (width != width_ || height != height_ || samples != asked_) resize(width, height, samples);
  glBindFramebuffer(GL_FRAMEBUFFER, samples_ > 0 ? sampled_ : picture_);
  glViewport(0, 0, width, height);
}

void Target::resize(int width, int height, int samples) {
  width_ = width;
  height_ = height;
  asked_ = samples;
  GLint most = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  while (glGetError() != GL_NO_ERROR) continue;
  for (int tried = std::min(samples, most);; tried /= 2) {
    if (allocate(tried)) return;
    if (tried == 0) break;
  }
  asked_ = -1;
  throw std::runtime_error("OpenGL: no framebuffer of " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
}

bool Target::allocate(int samples) {
  samples_ = samples;
  color_ = GlName(GlKind::Renderbuffer);
  depth_ = GlName(GlKind::Renderbuffer);
  picture_ = GlName(GlKind::Framebuffer);
  store(color_, GL_RGBA8, width_, height_, 0);
  store(depth_, GL_DEPTH_COMPONENT24, width_, height_, samples);
  glBindFramebuffer(GL_FRAMEBUFFER, picture_);
  attach(GL_COLOR_ATTACHMENT0, color_);
  if (samples == 0) attach(GL_DEPTH_ATTACHMENT, depth_);
  if (!is_complete()) return false;
  if (samples == 0) return true;

  sampled_color_ = GlName(GlKind::Renderbuffer);
  sampled_ = GlName(GlKind::Framebuffer);
  store(sampled_color_, GL_RGBA8, width_, height_, samples);
  glBindFramebuffer(GL_FRAMEBUFFER, sampled_);
  attach(GL_COLOR_ATTACHMENT0, sampled_color_);
  attach(GL_DEPTH_ATTACHMENT, depth_);
  return is_complete();
}

void Target::resolve() const {
  if (samples_ > 0) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, sampled_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, picture_);
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, picture_);
}

void Target::show() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

Image Target::read() const {
  Image image{width_, height_, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width_) * height_)};
  if (image.pixels.empty()) return image;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());

  // OpenGL's rows start at the bottom
  const std::size_t row = 3 * static_cast<std::size_t>(width_);
  for (int top = 0, bottom = height_ - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(&image.pixels[top * row], &image.pixels[top * row] + row, &image.pixels[bottom * row]);
  return image;
}

}  // namespace hooke
