// How a scene is stepped: method, frame rate, substeps and speed.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace hooke {

struct Integrator;

// The default method, `velocity_verlet` (integrator.cpp).
const Integrator& default_integrator();

// Method and substeps of a group of parts of the scene (automatic/islands.h).
struct IslandSteps {
  const Integrator* integrator = &default_integrator();
  int substeps = 1;
  bool operator==(const IslandSteps&) const = default;
};

// Those of all groups, in their order. Not a vector, so that settings are copied as plain values.
class IslandStepsList {
 public:
  static constexpr std::size_t max_size = 12;  // groups differ by a factor of 3
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  void clear() { *this = {}; }
  void push_back(const IslandSteps& steps) { steps_[size_++] = steps; }
  IslandSteps* begin() { return steps_.data(); }
  IslandSteps* end() { return steps_.data() + size_; }
  const IslandSteps* begin() const { return steps_.data(); }
  const IslandSteps* end() const { return steps_.data() + size_; }
  const IslandSteps& operator[](std::size_t group) const { return steps_[group]; }
  bool operator==(const IslandStepsList&) const = default;

 private:
  std::array<IslandSteps, max_size> steps_{};
  std::size_t size_ = 0;
};

struct Settings {
  const Integrator* integrator = &default_integrator();
  double frame_rate = 60.0;  // [1/s], > 0: a frame is 1 / frame_rate of simulated time
  int substeps = 20;         // per frame, >= 1
  double speed = 1.0;        // simulated seconds per real second, > 0
  // [m], > 0: local error allowed a step of an adaptive method; with `auto`, the error that a simulated second may add
  std::optional<double> tolerance;
  double budget_ms = 0.0;     // [ms], of a frame, by the model of the cost of `auto` (automatic/cost_model.h); 0: no limit
  IslandStepsList islands{};  // of a frame of `auto` that is computed again; in no file. Empty: the scene is stepped as a whole
  // In a frame that is computed again to measure its error: substeps end where a spring is about to break. In no file.
  bool locates_breaks = false;
  // Drag and dashpots are in the energy ledger of the frame, at the cost of about a force evaluation for each substep. In no file.
  bool measures_damping = false;
  bool operator==(const Settings&) const = default;

  double substep() const { return 1.0 / (frame_rate * substeps); }
};

}  // namespace hooke
