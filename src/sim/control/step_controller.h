// How many substeps the next attempt at a frame, and the next frame, take.
#pragma once

namespace hooke {

// An estimated frame.
struct EstimatedFrame {
  int substeps = 2;
  double error = 0.0;  // [m]
  int order = 1;
  double ratio_before = 0.0;  // MethodChoice::ratio of the frame before; 0: none
};

// [1], of an error to the one that the controller aims at, where `share` [m] is allowed to a frame.
double ratio_to_aim(double error, double share);

// Whether the frame is kept. Otherwise it is computed again with refined_substeps: 2, 4 or 8 times as many.
bool is_accepted(double error, double share);
int refined_substeps(const EstimatedFrame& frame, double share);

// Of the frame after an accepted one:
//   n' = n r^(0.7 / p) r_before^(-0.4 / p),  r = error / aim     (Gustafsson 1991, PI control)
// at least half and at most twice as many, an even number.
int next_substeps(const EstimatedFrame& frame, double share);

}  // namespace hooke
