// Frames computed by compute shaders of OpenGL 4.3, on a graphics card or, without one, by the software renderer.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/compute_context.h"
#include "device/gpu_scene.h"
#include "sim/step/frame_device.h"

namespace hooke {

class GpuDevice final : public FrameDevice {
 public:
  // Throws std::runtime_error with one line where there is no OpenGL 4.3.
  GpuDevice() = default;
  // In single precision if the plan is computed in it. The processor computes frames in which breaks are located, and all of them after a
  // failure of the device. Throws OptionError for a scene that needs the processor.
  bool advance(const Plan& plan, const FrameSteps& steps, Motion& motion, std::vector<Index>& broken) override;

  const std::string& renderer() const { return context_.renderer(); }
  // Why the device stopped; empty: it did not.
  const std::string& failure() const { return failure_; }

 private:
  ComputeContext context_;
  GpuScene single_{true}, double_{false};
  std::string failure_;
};

// What of a scene and its method only the processor computes, by name: "the force bending"; empty: nothing.
std::string needs_processor(const Plan& plan, const Integrator& method);

// "GPU: ..." with the renderer, or why there is none: a line of --version.
std::string describe_gpu();

}  // namespace hooke
