// Contact between points, springs and faces. Where the criterion counts crossings, a test repeats the run with a count of its own.
#include <algorithm>

#include "scene/crossed_parts.h"
#include "sim/contact/closest.h"
#include "sim/methods/rows.h"
#include "sim/plan/surface_plan.h"
#include "study/hard_cases/contact_scenes.h"
#include "study/hard_cases/monitored_run.h"
#include "study/hard_cases/rows.h"

namespace hooke {
namespace {

// The quick subset has one explicit method of each kind, and xpbd.
constexpr auto slow_methods =
    method_list<explicit_euler, symplectic_euler, blanes_moan4, dop853, implicit_euler, baraff_witkin, implicit_midpoint, tr_bdf2, esdirk4>;

// [1], of the energy supplied: by how much it may rise.
constexpr double max_rise = 1e-2;

// The energy of first-order methods is that of the scene only on average; `auto` reports where impacts keep it from its tolerance.
Expectation expectation_in_contact(const MonitoredRun& run) {
  const bool may_report = run.settings().integrator->order == 1 || is_automatic(run.settings());
  return may_report ? Expectation::HoldOrReport : expectation_of(run);
}

// Calls look() after each frame.
template <class Look>
void run_scene(MonitoredRun& run, const ContactScene& scene, const Look& look) {
  bool is_released = false;
  while (run.state().time < scene.seconds - 1e-9) {
    if (!is_released && run.state().time >= scene.release_time) {
      SetNailed release;
      for (const PointId id : scene.released) release.items.push_back({id, false});
      run.lab().submit(release);
      is_released = true;
    }
    if (!run.frame()) return;
    look();
  }
}

// The minimum distance between two springs that touch, those that no other spring joins [m], up to `reach`.
double min_spring_distance(const System& system, const State& state, double reach) {
  const SurfacePlan plan = plan_surface(system);
  std::vector<Vec3> x, low, high;
  for (const Index i : plan.points) x.push_back(state.position[i]);
  for (const auto& [i, j] : plan.edges) {
    low.push_back(glm::min(x[i], x[j]) - Vec3(0.5 * reach));
    high.push_back(glm::max(x[i], x[j]) + Vec3(0.5 * reach));
  }
  double min = reach;
  for (Index e = 0; e < static_cast<Index>(plan.edges.size()); ++e)
    for (Index f = e + 1; f < static_cast<Index>(plan.edges.size()); ++f) {
      const bool is_apart = glm::any(glm::lessThan(high[e], low[f])) || glm::any(glm::lessThan(high[f], low[e]));
      if (is_apart || plan.excludes_edge(e, f)) continue;
      const auto& [a, b] = plan.edges[e];
      const auto& [c, d] = plan.edges[f];
      min = std::min(min, closest_points(FeaturePair::TwoEdges, {x[a], x[b], x[c], x[d]}).distance);
    }
  return min;
}

template <ContactScene (*make)()>
Verdict judge_cloth(const Integrator& method) {
  const ContactScene scene = make();
  MonitoredRun run(scene.network, settings_for(method, scene), {.energy = max_rise});
  std::size_t worst = 0;
  run_scene(run, scene, [&] { worst = std::max(worst, count_crossings(run.system(), run.state())); });
  const double rise = run.monitor().energy_rise();
  return judge(run, expectation_in_contact(run), worst == 0 && rise < max_rise,
               formatted("%zu crossings, energy rises %.1g, %d substeps", worst, rise, run.settings().substeps));
}

Verdict judge_rope_heap(const Integrator& method) {
  const ContactScene scene = make_rope_heap();
  const double thickness = scene.network.system.contact.thickness;
  MonitoredRun run(scene.network, settings_for(method, scene), {.energy = max_rise});
  double closest = thickness;
  run_scene(run, scene, [&] { closest = std::min(closest, min_spring_distance(run.system(), run.state(), thickness)); });
  const double rise = run.monitor().energy_rise();
  return judge(run, expectation_in_contact(run), closest > 0.25 * thickness && rise < max_rise,
               formatted("ropes %.2g mm apart, energy rises %.1g, %d substeps", 1e3 * closest, rise, run.settings().substeps));
}

}  // namespace

constinit const HardCase folded_cloth_case{
    .number = 28,
    .name = "Folded cloth",
    .parameters =
        "25 x 13 points, 1 m, 0.2 kg, k = 300 N/m, folded in halves three times, its eight layers 6 mm apart, dropped by 0.3 m, thickness "
        "4 mm, "
        "0.6 s",
    .criterion = "no edge passes through a face at the end of any frame; the energy rises by less than 1e-2 of that supplied",
    .slow_under = slow_methods,
    .judge = judge_cloth<make_folded_cloth>,
};

constinit const HardCase crossing_cloths_case{
    .number = 29,
    .name = "Cloths at 20 m/s",
    .parameters =
        "two sheets of 13 x 13 points, 1 m, one across the other, fly at each other at 20 m/s in free space, thickness 4 mm, 0.3 s",
    .criterion = "no edge passes through a face at the end of any frame; the energy rises by less than 1e-2 of that supplied",
    .slow_under = slow_methods,
    .judge = judge_cloth<make_crossing_cloths>,
};

constinit const HardCase twisted_tube_case{
    .number = 30,
    .name = "Twisted tube",
    .parameters =
        "a tube of cloth of 12 x 41 points, 1 m long, radius 0.06 m, between two rings of nails, twisted by four turns; after 0.3 s the "
        "lower ring is released; 0.6 s",
    .criterion = "no edge passes through a face at the end of any frame; the energy rises by less than 1e-2 of that supplied",
    .slow = true,
    .judge = judge_cloth<make_twisted_tube>,
};

constinit const HardCase pulled_sleeve_case{
    .number = 31,
    .name = "Hand through a sleeve",
    .parameters =
        "a hanging sheet of 11 x 11 points, bent into a sleeve; a hand pulls a lower corner through it at 10 m/s for 0.5 s; 0.8 s",
    .criterion = "no edge passes through a face at the end of any frame; the energy rises by less than 1e-2 of that supplied",
    .slow_under = slow_methods,
    .judge = judge_cloth<make_pulled_sleeve>,
};

constinit const HardCase rope_heap_case{
    .number = 32,
    .name = "Heap of ropes",
    .parameters = "20 ropes of 11 points, 0.5 m, k = 500 N/m, fall crosswise into a bin of 0.6 m, thickness 10 mm, 2 s",
    .criterion = "ropes stay more than a quarter of their thickness apart; the energy rises by less than 1e-2 of that supplied",
    .remark =
        "two ropes start 3.8 mm apart, and are 7.4 mm apart after a frame; impacts compress the heap, because the sweeps do not solve for "
        "all impulses together; scripts/contact checks in every substep that no rope passes through another",
    .slow_under = slow_methods,
    .judge = judge_rope_heap,
};

}  // namespace hooke
