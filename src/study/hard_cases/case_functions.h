// The cases by their families, gathered by hard_cases.cpp.
#pragma once

#include "study/hard_cases/hard_case.h"

namespace hooke {

// stiff.cpp
Verdict judge_stiff_spring(const Integrator& method);
Verdict judge_crumpled_sheet(const Integrator& method);
Verdict judge_compressed_sheet(const Integrator& method);
Verdict judge_huge_damping(const Integrator& method);

// chains.cpp
Verdict judge_mass_ratio(const Integrator& method);
Verdict judge_long_chain(const Integrator& method);
Verdict judge_over_constrained(const Integrator& method);

// degenerate.cpp
Verdict judge_zero_length_spring(const Integrator& method);
Verdict judge_coincident_points(const Integrator& method);
Verdict judge_nothing_to_move(const Integrator& method);
Verdict judge_springs_on_one_point(const Integrator& method);

// fast_drag.cpp
Verdict judge_fast_drag(const Integrator& method);

// hand.cpp
Verdict judge_resonance(const Integrator& method);
Verdict judge_slider_jumps(const Integrator& method);

// border.cpp
Verdict judge_one_substep(const Integrator& method);
Verdict judge_bad_input(const Integrator& method);
Verdict judge_hidden_window(const Integrator& method);
Verdict judge_determinism(const Integrator& method);

// buckling.cpp
Verdict judge_snap_through(const Integrator& method);
Verdict judge_chaotic_curtain(const Integrator& method);
Verdict judge_tangled_start(const Integrator& method);

// contact.cpp
Verdict judge_cloth_on_ball(const Integrator& method);
Verdict judge_fast_impact(const Integrator& method);
Verdict judge_endless_bounces(const Integrator& method);

// scale.cpp
Verdict judge_refinement(const Integrator& method);
Verdict judge_large_coordinates(const Integrator& method);
Verdict judge_islands(const Integrator& method);

}  // namespace hooke
