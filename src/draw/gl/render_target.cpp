#include "draw/gl/render_target.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hooke {
namespace {

void attach(GLenum place, GLenum format, const GlName& store, int width, int height, int samples) {
  glBindRenderbuffer(GL_RENDERBUFFER, store);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, store);
}

void clear_errors() {
  while (glGetError() != GL_NO_ERROR) continue;
}

}  // namespace

bool RenderTarget::Layer::allocate(int new_width, int new_height, int new_samples) {
  *this = {GlName(GlKind::Framebuffer), GlName(GlKind::Renderbuffer), GlName(GlKind::Renderbuffer), new_width, new_height, new_samples};
  clear_errors();
  glBindFramebuffer(GL_FRAMEBUFFER, frame);
  attach(GL_COLOR_ATTACHMENT0, GL_RGBA8, color, width, height, samples);
  attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, depth, width, height, samples);
  const bool made = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE && glGetError() == GL_NO_ERROR;
  if (!made) *this = {};
  return made;
}

void RenderTarget::begin(int width, int height) {
  if (!picture_.fits(width, height) && !picture_.allocate(width, height, 0))
    throw std::runtime_error("OpenGL: no framebuffer of " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
  glBindFramebuffer(GL_FRAMEBUFFER, picture_.frame);
  glViewport(0, 0, width, height);
}

bool RenderTarget::begin_multisampled(int samples) {
  if (!sampled_.fits(picture_.width, picture_.height) || asked_ != samples) allocate_sampled(samples);
  glBindFramebuffer(GL_FRAMEBUFFER, sampled_.samples > 0 ? sampled_.frame : picture_.frame);
  return sampled_.samples > 0;
}

void RenderTarget::allocate_sampled(int samples) {
  GLint max = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &max);
  asked_ = samples;
  for (int tried = std::min(samples, max); tried > 1; tried /= 2)
    if (sampled_.allocate(picture_.width, picture_.height, tried)) return;

  // No multisampling is available.
  sampled_ = {};
  sampled_.width = picture_.width;
  sampled_.height = picture_.height;
}

void RenderTarget::resolve(const PixelBox& part) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, sampled_.frame);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, picture_.frame);
  glBlitFramebuffer(part.left, part.bottom, part.right, part.top, part.left, part.bottom, part.right, part.top,
                    GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, picture_.frame);
}

void RenderTarget::show() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture_.frame);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, picture_.width, picture_.height, 0, 0, picture_.width, picture_.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

Image RenderTarget::read(bool with_opacity) const {
  const int width = picture_.width, height = picture_.height, channels = with_opacity ? 4 : 3;
  Image image{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(channels) * width * height), channels};
  if (image.pixels.empty()) return image;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture_.frame);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, with_opacity ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());

  // Rows in OpenGL start at the bottom.
  const std::size_t row = static_cast<std::size_t>(channels) * width;
  for (int top = 0, bottom = height - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(&image.pixels[top * row], &image.pixels[top * row] + row, &image.pixels[bottom * row]);
  // blended with a transparent background, colors are multiplied by their opacity
  for (std::size_t i = 0; with_opacity && i < image.pixels.size(); i += 4)
    for (std::size_t c = i; c < i + 3 && image.pixels[i + 3] > 0; ++c)
      image.pixels[c] = static_cast<std::uint8_t>(std::min(255, image.pixels[c] * 255 / image.pixels[i + 3]));
  return image;
}

}  // namespace hooke
