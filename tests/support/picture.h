// Pictures for tests: drawn without a display, read from files, compared.
#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <filesystem>

#include "batch/offscreen.h"
#include "draw/gl/gl.h"
#include "draw/view.h"
#include "support/test_sim.h"

namespace hooke {

inline Snapshot snapshot_of(const TestSim& sim) {
  Snapshot snapshot{.system = std::make_shared<const System>(sim.system), .state = sim.state};
  for (const Spring& spring : sim.system.springs()) {
    const double stretched = strain(sim.system, sim.state, spring);
    if (!std::isfinite(stretched)) continue;
    snapshot.min_strain = std::min(snapshot.min_strain, stretched);
    snapshot.max_strain = std::max(snapshot.max_strain, stretched);
  }
  return snapshot;
}

inline Image draw(const TestSim& sim, const Marks& marks, const Camera& camera, const ViewOptions& options, int width, int height) {
  const Offscreen offscreen;
  View view;
  view.draw(snapshot_of(sim), marks, camera, options, width, height, nullptr);
  Image image = view.read();
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
  return image;
}

inline Color at(const Image& image, int x, int y) {
  const std::uint8_t* pixel = &image.pixels[3 * (static_cast<std::size_t>(y) * image.width + x)];
  return {pixel[0], pixel[1], pixel[2]};
}

// The color at the pixel nearest to a position.
inline Color at(const Image& image, const Camera& camera, const Vec3& place) {
  const Vec3 seen = camera.project(place, {image.width, image.height});
  return at(image, static_cast<int>(seen.x), static_cast<int>(seen.y));
}

inline int brightness(const Color& color) { return color.red + color.green + color.blue; }

inline Image read_png(const std::filesystem::path& file) {
  png_image png{.version = PNG_IMAGE_VERSION};
  Image image;
  if (!png_image_begin_read_from_file(&png, file.c_str())) return image;
  png.format = PNG_FORMAT_RGB;
  image.width = static_cast<int>(png.width);
  image.height = static_cast<int>(png.height);
  image.pixels.resize(PNG_IMAGE_SIZE(png));
  png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr);
  return image;
}

// The fraction of channels that differ by more than 5/255; 1 if the sizes differ.
inline double difference(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.pixels.empty()) return 1.0;
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) different += std::abs(a.pixels[i] - b.pixels[i]) > 5;
  return static_cast<double>(different) / static_cast<double>(a.pixels.size());
}

}  // namespace hooke
