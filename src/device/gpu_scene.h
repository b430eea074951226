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

// A motion that stays on the device, whose next frame sends none of it: the run, its repeated frame, or one of its second runs.
struct ResidentMotion {
  std::array<GLuint, 3> states{};  // in turn: the start of a substep is kept until contact has corrected its end
  int state = 0;                   // the present one
  Field x, v;                      // as they were read
};

// The uniforms of a pass.
struct PassUniforms {
  PassKind pass = WholeKick;
  int moment = 0;
  bool acts_predicted = false;
  int substep = 0, reused = -1;
  Index first = 0, end = 0;  // the range of dashpots
};

class GpuScene {
 public:
  explicit GpuScene(bool is_single) : is_single_(is_single) {}
  // The steps from the start of the frame, with the context current; for scenes that do not need the processor. Throws
  // std::runtime_error, and has changed nothing then.
  void advance(const GlFunctions& gl, Plan& plan, const FrameSteps& steps, Motion& motion, std::vector<Index>& broken);

 private:
  void upload(const FrameSteps& steps, const Motion& motion);
  void find_resident(const Motion& motion);
  void fill(GLuint& buffer, std::size_t bytes, const void* content);
  void fill(GLuint& buffer, std::span<const std::byte> bytes) { fill(buffer, bytes.size(), bytes.data()); }
  bool put(Binding binding, std::span<const std::byte> bytes);
  bool put(Binding binding, std::span<const Index> numbers) { return put(binding, std::as_bytes(numbers)); }
  bool put(Binding binding, std::span<const double> numbers);
  std::size_t state_bytes() const { return 12 * static_cast<std::size_t>(plan_->points) * (is_single_ ? sizeof(float) : sizeof(double)); }
  GLuint present() const { return resident_->states[static_cast<std::size_t>(state_)]; }
  template <class Number>
  std::vector<Number> read(GLuint buffer, std::size_t count) const;
  std::vector<double> read_numbers(GLuint buffer, std::size_t count) const;
  std::string definitions() const;
  GLuint program_of(std::string_view pass);
  void run(std::string_view pass, Index threads, int from, int to, const PassUniforms& call);
  void move(const PassUniforms& call);
  void run_fused(const FrameSteps& steps);
  void run_one_by_one(const FrameSteps& steps);
  void sweep(bool is_forward);
  void book_works(const Field& start, Motion& motion);
  void break_springs(const std::vector<double>& limits, Motion& motion, std::vector<Index>& broken);

  const bool is_single_;
  const GlFunctions* gl_ = nullptr;
  Plan* plan_ = nullptr;
  std::string definitions_;                 // one #define for each feature of the scene
  std::map<std::string, GLuint> programs_;  // by definitions and pass
  std::array<GLuint, bindings> buffers_{};
  std::array<ResidentMotion, 4> residents_;  // the last used first
  ResidentMotion* resident_ = nullptr;
  int state_ = 0, start_ = 0;  // of its states: the present one, and that at the start of the substep
  SweepLevels sweeps_;         // for methods that sweep over dashpots
  // What the buffers contain, so that only what has changed is sent again, and what it was made for.
  std::array<std::vector<std::byte>, bindings> contents_;
  std::vector<SpringRun> runs_;
  SpringGraph graph_;
  std::vector<double> inverse_mass_;
  double sweep_ = 0.0;  // [s], duration of the sweeps
};

}  // namespace hooke
