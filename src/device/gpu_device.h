// Frames computed by compute shaders of OpenGL 4.3, on a graphics card or, without one, by the software renderer.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "device/compute_context.h"
#include "device/gpu_scene.h"
#include "sim/step/frame_device.h"

namespace hooke {

class GpuDevice final : public FrameDevice {
 public:
  // As ComputeContext: throws std::runtime_error where there is no OpenGL 4.3.
  explicit GpuDevice(const std::function<void(GlFunctions&)>& change = {}, std::initializer_list<ContextKind> kinds = context_kinds)
      : context_(change, kinds) {}
  // In single precision if the plan is computed in it. The processor computes frames in which breaks are located or which it refuses, and
  // all of them after a failure of the device.
  bool advance(Plan& plan, const FrameSteps& steps, Motion& motion, std::vector<Index>& broken) override;
  // "not on the GPU: struts", or "the GPU stopped: out of memory".
  std::string refusal(const Plan& plan, const Integrator& method) const override;

  const std::string& renderer() const { return context_.renderer(); }

 private:
  ComputeContext context_;
  GpuScene single_{true}, double_{false};
  std::string failure_;
};

// What of a scene and its method only the processor computes, by name: "the force bending"; empty: nothing.
std::string needs_processor(const Plan& plan, const Integrator& method);

// "GPU: ..." with the renderer, or why there is none: a line of --version.
std::string describe_gpu();
// Whether that is a graphics card, not the software renderer.
bool has_graphics_card();

}  // namespace hooke
