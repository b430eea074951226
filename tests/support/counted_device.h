// A device that counts the frames that it computed, on whatever renderer this machine has.
#pragma once

#include <vector>

#include "device/gpu_device.h"

namespace hooke {

class CountedDevice final : public FrameDevice {
 public:
  bool advance(Plan& plan, const FrameSteps& steps, Motion& motion, std::vector<Index>& broken) override {
    const bool done = device().advance(plan, steps, motion, broken);
    frames += done ? 1 : 0;
    return done;
  }
  // One for all tests, which compiles each pass once.
  static GpuDevice& device() {
    static GpuDevice device;
    return device;
  }
  int frames = 0;
};

}  // namespace hooke
