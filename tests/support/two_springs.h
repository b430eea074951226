// A nail and two points on a line, and what tests of panels read from a window with them.
#pragma once

#include <chrono>
#include <string_view>

#include "scene/parameters.h"
#include "support/flat_scene.h"
#include "support/gui_fixture.h"

namespace hooke {

inline Scene two_springs() {
  TestSim sim;
  const PointId a = sim.nail({-0.5, 0.0, 0.0}), b = sim.add({0.0, 0.0, 0.0}), c = sim.add({0.5, 0.0, 0.0});
  sim.join(a, b, 100.0, 0.5);
  sim.join(b, c, 100.0, 0.5);
  return flat_scene("Two springs", sim);
}

inline double value_of(GuiFixture& gui, std::string_view name) {
  const auto rows = parameters();
  const Status& status = gui.status();
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].name == name) return status.document->parameter_values[i];
  return -1.0;
}

// Predictions are computed in another thread and appear when they are ready.
inline bool eventually_shows(GuiFixture& gui, const char* words) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (gui.text().find(words) == std::string::npos)
    if (std::chrono::steady_clock::now() > until) return false;
  return true;
}

}  // namespace hooke
