// Pictures, drawn without a display.
#include <gtest/gtest.h>

#include "cli/offscreen.h"
#include "draw/view.h"
#include "trial.h"

namespace hooke {
namespace {

Snapshot snapshot_of(const Trial& trial) {
  Snapshot snapshot{.system = std::make_shared<const System>(trial.system), .state = trial.state};
  for (const Spring& spring : trial.system.springs()) {
    const double stretched = strain(trial.system, trial.state, spring);
    snapshot.least_strain = std::min(snapshot.least_strain, stretched);
    snapshot.most_strain = std::max(snapshot.most_strain, stretched);
  }
  return snapshot;
}

Image draw(const Trial& trial, const Marks& marks, const Camera& camera, const ViewOptions& options, int width, int height) {
  const Offscreen offscreen;
  View view;
  view.draw(snapshot_of(trial), marks, camera, options, width, height, nullptr);
  return view.read();
}

TEST(Picture, OfAnEmptySceneIsTheBackground) {
  const Trial empty;
  const Image image = draw(empty, {}, make_camera({}, empty.system, empty.state, 1.0), {.grid = false}, 16, 16);
  ASSERT_EQ(image.pixels.size(), 3u * 16 * 16);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    EXPECT_EQ(image.pixels[i], 32);
    EXPECT_EQ(image.pixels[i + 1], 36);
    EXPECT_EQ(image.pixels[i + 2], 40);
  }
}

}  // namespace
}  // namespace hooke
