#include "sim/plan/law_springs.h"

namespace hooke {

void plan_laws(Plan& plan, const System& system) {
  LawSprings& laws = plan.spring.laws;
  laws = {.clock = system.muscles};
  if (!system.springs().have_laws()) return;
  laws.of_packed.assign(plan.springs, no_index);
  for (const SpringRun& run : plan.spring.runs)
    for (Index e = 0; e < run.count; ++e) {
      const Spring spring = system.springs()[plan.spring.index[run.begin + e]];
      if (!spring.law) continue;
      laws.of_packed[run.begin + e] = static_cast<Index>(laws.springs.size());
      laws.springs.push_back({.first = run.first + e,
                              .second = run.second + e,
                              .law = *spring.law,
                              .stiffness = system.stiffness_of(spring),
                              .damping = system.damping_of(spring),
                              .rest_length = spring.rest_length});
      laws.move = laws.move || (spring.law->moves() && system.muscles.rate() != 0.0);
    }
  if (laws.springs.empty()) laws = {};
}

}  // namespace hooke
