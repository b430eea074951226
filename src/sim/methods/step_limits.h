// What steps are stable on a scene, and short enough for what they must resolve: whoever needs a step asks here.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/methods/integrator.h"
#include "sim/methods/passage_step.h"

namespace hooke {

// What steps have to resolve besides the linear limit.
struct StepNeeds {
  int margin = default_margin;  // below that limit (recommended_margin)
  Passage passage{};            // shortest_passage
  double oscillation =
      std::numeric_limits<double>::infinity();  // [s], the longest step that resolves the oscillations of colliders and muscles
};
// `state`: the one from which the scene runs.
StepNeeds step_needs(const System& system, const State& state);

// The solid collider or the muscle that oscillates fastest.
struct Oscillation {
  bool is_muscle = false;
  std::size_t index = 0;                                            // into the colliders or springs
  double resolving_step = std::numeric_limits<double>::infinity();  // [s]; infinity: there is none
};
Oscillation fastest_oscillation(const System& system);

class StepLimits {
 public:
  explicit StepLimits(const Spectrum& spectrum, const StepNeeds& needs = {}) : spectrum_(spectrum), needs_(needs) {}

  // The same object for another state or scene: what was computed of the spectrum is kept if that is the same.
  void update(const Spectrum& spectrum, const StepNeeds& needs);

  // [s], the longest step at which no linear mode grows, and at which contact causes no growth; 0: none, infinity: any.
  double stable_step(const Integrator& method) const;
  // Whether contact sets it, not the linear modes.
  bool is_set_by_contact(const Integrator& method) const;
  // "its linear stability limit is 12 substeps per frame", "contact may cause growth with fewer than 819 substeps per frame"; empty without
  // a limit. The only words for it: of the panel, the banner and the command line.
  std::string limit_text(const Integrator& method, double frame_rate) const;
  // The fewest substeps per frame within that limit; none if no step is stable, or there are too many.
  std::optional<int> stable_substeps(const Integrator& method, double frame_rate) const;
  // The fewest that resolve passages and oscillations, 1 without any; none if there are too many.
  std::optional<int> resolving_substeps(const Integrator& method, double frame_rate) const;
  // The fewest that are both; none if there are too many.
  std::optional<int> min_substeps(const Integrator& method, double frame_rate) const;
  // The fewest that are recommended: with the margin below the linear limit that motion far from equilibrium needs.
  std::optional<int> recommended_substeps(const Integrator& method, double frame_rate) const;

  const Spectrum& spectrum() const { return spectrum_; }
  const StepNeeds& needs() const { return needs_; }

 private:
  Spectrum spectrum_;
  StepNeeds needs_;
  mutable std::vector<std::pair<const Integrator*, double>> stable_steps_;  // those computed so far: each takes hundreds of evaluations
};

}  // namespace hooke
