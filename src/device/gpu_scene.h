// The buffers of a scene on the device, and the passes of a frame over them (shaders/compute).
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "device/compute_context.h"
#include "device/packed_scene.h"

namespace hooke {

// The files of shaders/compute, embedded in the program.
struct ComputeSource {
  std::string_view name, text;
};
std::span<const ComputeSource> compute_sources();

class GpuScene {
 public:
  explicit GpuScene(bool is_single) : is_single_(is_single) {}
  // The steps from the start of the frame, with the context current; for scenes that do not need the processor. Throws
  // std::runtime_error, and has changed nothing then.
  void advance(const GlFunctions& gl, const Plan& plan, const FrameSteps& steps, Motion& motion, std::vector<Index>& broken);

 private:
  // The uniforms of a pass.
  struct Call {
    PassKind pass = WholeKick;
    int moment = 0;
    bool acts_predicted = false;
    int substep = 0, reused = -1;
    Index first = 0, end = 0;  // the range of dashpots
  };

  void upload(const Plan& plan, const FrameSteps& steps, const Motion& motion);
  void upload_state(const Motion& motion);
  void put(Binding binding, std::span<const std::byte> bytes);
  void put(Binding binding, std::span<const Index> numbers) { put(binding, std::as_bytes(numbers)); }
  void put(Binding binding, std::span<const double> numbers);
  template <class Number>
  std::vector<Number> read(GLuint buffer, std::size_t count) const;
  std::vector<double> read_numbers(GLuint buffer, std::size_t count) const;
  std::string definitions() const;
  GLuint program_of(std::string_view pass);
  void run(std::string_view pass, Index threads, int from, int to, const Call& call);
  void move(const Call& call);
  void run_fused(const FrameSteps& steps);
  void run_one_by_one(const FrameSteps& steps);
  void sweep(bool is_forward);
  void read_broken(Motion& motion, std::vector<Index>& broken);

  const bool is_single_;
  const GlFunctions* gl_ = nullptr;
  const Plan* plan_ = nullptr;
  std::string definitions_;                 // one #define for each feature of the scene
  std::map<std::string, GLuint> programs_;  // by definitions and pass
  std::array<GLuint, bindings> buffers_{};
  std::array<GLuint, 3> states_{};  // in turn: the start of a substep is kept until contact has corrected its end
  int state_ = 0, start_ = 0;       // the present one, and that at the start of the substep
  SweepLevels sweeps_;              // for methods that sweep over dashpots
  // What the buffers contain, so that only what has changed is sent again.
  std::array<std::vector<std::byte>, bindings> contents_;
  std::vector<SpringRun> runs_;
  SpringGraph graph_;
};

}  // namespace hooke
