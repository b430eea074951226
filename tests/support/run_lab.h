// Runs a laboratory without a clock.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "lab/lab.h"
#include "support/apply_now.h"
#include "support/parse_text.h"

namespace hooke {

inline Lab lab_on(const char* scene) { return Lab(load_scene(find_scene(scene)).scene); }

// A sheet of 8 x 8 points, hung by two corners, that tears under its own weight.
inline Scene weak_sheet(const Integrator& method) {
  Scene scene = parse(R"({"hooke": 1, "break_strain": 0.12, "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0],
    "down": [0, -1, 0.3], "points": [8, 8], "mass": 1, "stiffness": 120, "damping": 0.2, "nail": ["top_left", "top_right"]}],
    "simulation": {"substeps": 20}})");
  scene.settings.integrator = &method;
  return scene;
}

inline void run(Lab& lab, int frames) {
  for (int i = 0; i < frames; ++i) ASSERT_TRUE(lab.step()) << "frame " << i;
}
inline void submit_and_apply(Lab& lab, const Control& control) {
  lab.submit(control);
  apply_now(lab);
}

}  // namespace hooke
