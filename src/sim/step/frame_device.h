// What computes frames in place of the processor, such as a graphics card (src/device).
#pragma once

#include <string>
#include <vector>

#include "sim/forces/motion.h"
#include "sim/methods/integrator.h"

namespace hooke {

// `count` steps of h [s].
struct FrameSteps {
  const Integrator& method;
  double h = 0.0;
  int count = 1;
  bool locates_breaks = false;  // as in Settings
};

class FrameDevice {
 public:
  virtual ~FrameDevice() = default;
  // Leads the motion from the start of a frame to its end, and breaks springs (forces/spring_limits.h). False: it has
  // changed nothing, and the processor computes the frame.
  virtual bool advance(Plan& plan, const FrameSteps& steps, Motion& motion, std::vector<Index>& broken) = 0;
  // Why the processor computes the frames of this plan by this method, in a few words; empty: the device does.
  virtual std::string refusal(const Plan&, const Integrator&) const { return {}; }
};

}  // namespace hooke
