// A laboratory with a tool and a camera, without a window, for the tests of tools.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "app/tools/tools.h"
#include "support/test_sim.h"

namespace hooke {

// Polls until the condition holds, for up to ten seconds.
template <class Condition>
bool wait_for(Condition condition) {
  for (int i = 0; i < 2000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

struct ToolFixture {
  explicit ToolFixture(Scene scene) : lab(std::move(scene)), context{lab, lab.status(), {}} {
    context.size = {800.0, 600.0};
    context.camera.distance = 4.0;
  }

  LabThread lab;
  ToolContext context;
  Selection& selection = context.selection;

  void settle() {
    ASSERT_TRUE(lab.settle(std::chrono::seconds(10)));
    context.status = lab.status();
  }
  void submit(Control control) {
    lab.submit(std::move(control));
    settle();
  }

  glm::dvec2 seen(const Vec3& place) const { return *project_to_screen(context.view_transform(), place); }
  Pointer pointer(const Vec3& place, bool shift = false) const { return {seen(place), {.shift = shift}}; }

  void press(Tool& tool, const Vec3& place, bool shift = false) { act(&Tool::press, tool, place, shift); }
  void follow(Tool& tool, const Vec3& place) { act(&Tool::follow, tool, place, false); }
  void release(Tool& tool, const Vec3& place, bool shift = false) { act(&Tool::release, tool, place, shift); }
  void click(Tool& tool, const Vec3& place, bool shift = false) {
    press(tool, place, shift);
    release(tool, place, shift);
  }
  // Press, move, release.
  void drag(Tool& tool, const Vec3& from, const Vec3& to, bool shift = false) {
    press(tool, from, shift);
    for (const double fraction : {0.2, 0.6, 1.0}) follow(tool, glm::mix(from, to, fraction));
    release(tool, to, shift);
  }

  const System& system() const { return context.system(); }
  const Vec3& position(Index i) const { return context.snapshot().state.position[i]; }
  const Vec3& velocity(Index i) const { return context.snapshot().state.velocity[i]; }

 private:
  void act(void (Tool::*what)(const Pointer&, ToolContext&), Tool& tool, const Vec3& place, bool shift) {
    (tool.*what)(pointer(place, shift), context);
    settle();
  }
};

// Points in a flat scene without gravity.
inline Scene flat_scene(std::initializer_list<Vec3> places) {
  TestSim sim;
  for (const Vec3& place : places) sim.add(place);
  Scene scene;
  scene.system = sim.system;
  scene.system.dimensions = 2;
  scene.system.gravity = Vec3(0.0);
  scene.state = sim.state;
  return scene;
}

}  // namespace hooke
