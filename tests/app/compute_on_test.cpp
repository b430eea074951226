// Compute on CPU or GPU, on whatever renderer this machine has.
#include <gtest/gtest.h>

#include "app/document/files.h"
#include "device/gpu_device.h"
#include "sim/methods/rows.h"
#include "support/gui_fixture.h"
#include "support/hanging_scene.h"

namespace hooke {
namespace {

TEST(ComputeOn, SaysWhatTheGpuDoesNotComputeAndGoesOnOnTheCpu) {
  GuiFixture gui(hanging());
  const auto& toast = gui.app().panels().messages.toast;
  const auto run = [&] {
    const double before = gui.status().snapshot->state.time;
    for (int i = 0; i < 3; ++i) gui.key(Key::Period);
    gui.frames(2);
    EXPECT_GT(gui.status().snapshot->state.time, before);
  };
  gui.app().handle(Request(Edit{SetIntegrator{&velocity_verlet}}));
  gui.key(letter('U'), control_shift);
  gui.frames(2);
  EXPECT_TRUE(gui.status().run.on_device);
  EXPECT_EQ(gui.status().run.device_refusal, "");
  EXPECT_EQ(toast.rfind("Computed on the GPU: ", 0), 0u) << toast;
  EXPECT_NE(gui.text().find("Compute on"), std::string::npos);
  run();

  gui.app().handle(Request(Edit{SetIntegrator{&dop853}}));
  gui.frames(3);
  EXPECT_EQ(toast.rfind("Computed on the CPU: not on the GPU: the method dop853", 0), 0u) << toast;
  EXPECT_NE(gui.text().find("not on the GPU: the method dop853"), std::string::npos) << gui.text();
  run();

  gui.app().handle(Request(Edit{SetIntegrator{&symplectic_euler}}));
  gui.frames(3);
  EXPECT_EQ(gui.status().run.device_refusal, "");
  run();
  gui.key(letter('U'), control_shift);
  gui.frames(2);
  EXPECT_FALSE(gui.status().run.on_device);
}

TEST(ComputeOn, AMillionPointsNeedAGraphicsCard) {
  const LoadedScene loaded = load_fitting(find_scene("million"));
  const bool is_fit = has_graphics_card();
  EXPECT_EQ(loaded.scene.system.point_count(), is_fit ? 1'000'000 : 16'384);
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings.front().find(is_fit ? "Compute on" : "16,384 points"), std::string::npos);
}

}  // namespace
}  // namespace hooke
