// On how many threads and in which precision steps are computed. Not part of a scene.
#pragma once

#include <memory>

namespace hooke {

class ThreadTeam;
class SinglePrecision;
class FrameDevice;
struct PhaseTimes;

struct Execution {
  // Shares long passes over grids and points, to the same bits for any number of threads; null: the calling thread computes alone.
  std::shared_ptr<ThreadTeam> team{};
  // Computes the steps between which nothing acts (single_precision.h); null: they are computed in double precision.
  std::shared_ptr<SinglePrecision> single{};
  // Computes frames in place of the processor (step/frame_device.h); null: nothing does.
  std::shared_ptr<FrameDevice> device{};
  // Measures what steps are spent on (phase_times.h), for as long as there are any; null: nothing does.
  PhaseTimes* phases = nullptr;
};

}  // namespace hooke
