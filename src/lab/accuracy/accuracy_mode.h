// What is measured of the accuracy of a run.
#pragma once

namespace hooke {

enum class AccuracyMode {
  Off,
  Frame,  // the error of a frame, a tenth of the cost of the run, and the energy balance, half of it where there are dashpots
  Full,   // and the second runs: about two and a half times the cost of the run
};

}  // namespace hooke
