// The hard cases on contact, with every method: nothing passes through, by a count that shares no code with it (support/crossings.h).
// With HOOKE_FULL set for their whole duration (scripts/contact), otherwise for as long as takes a second or so.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "study/hard_cases/contact_scenes.h"
#include "support/convergence.h"
#include "support/crossings.h"

namespace hooke {
namespace {

struct ContactCase {
  const char* name;
  ContactScene (*make)();
  double seconds;  // [s], without HOOKE_FULL; 0: not then
};

constexpr ContactCase contact_cases[] = {
    {"folded_cloth", make_folded_cloth, 0.1},  {"crossing_cloths", make_crossing_cloths, 0.05},
    {"twisted_tube", make_twisted_tube, 0.05}, {"pulled_sleeve", make_pulled_sleeve, 0.1},
    {"rope_heap", make_rope_heap, 0.3},
};

bool is_full() { return std::getenv("HOOKE_FULL") != nullptr; }

std::vector<ContactCase> cases_to_run() {
  std::vector<ContactCase> cases(std::begin(contact_cases), std::end(contact_cases));
  std::erase_if(cases, [](const ContactCase& each) { return !is_full() && each.seconds == 0.0; });
  return cases;
}

struct Passed {
  long crossings = 0;  // of edges and faces, the most at the end of a frame
  long passages = 0;   // of springs, in all substeps; only where springs touch
  int frames = 0;      // that were counted
};

bool is_finite_everywhere(const std::vector<Vec3>& x) {
  return std::ranges::all_of(x, [](const Vec3& each) { return std::isfinite(each.x + each.y + each.z); });
}

// Until `seconds`, or until it diverges.
Passed run_and_count(ContactScene scene, const Integrator& method, double seconds) {
  System& system = scene.network.system;
  State& state = scene.network.state;
  const Settings settings = settings_for(method, scene);
  const CrossingCounter crossings(system);
  const PassageCounter passages(system);
  Plan plan = make_plan(system);
  Frame frame;
  Passed passed;
  // a method that is stable at no step diverges within some frames
  const long frames = method.stability == Stability::None ? 1 : std::lround(60.0 * seconds);
  for (long i = 0; i < frames; ++i) {
    if (state.time >= scene.release_time && !scene.released.empty()) {
      for (const PointId id : scene.released) system.point(system.index_of(id)).nailed = false;
      scene.released.clear();
      plan = make_plan(system);
    }
    frame.begin(plan, system, settings, state);
    std::vector<Vec3> before = state.position, after = before;
    while (!frame.done()) {
      frame.substep(plan);
      if (!system.contact.springs) continue;
      for (std::size_t k = 0; k < after.size(); ++k)
        for (int c = 0; c < 3; ++c) after[k][c] = frame.motion().x[c * after.size() + k];
      passed.passages += passages.count(before, after);
      std::swap(before, after);
    }
    frame.end(plan, state);
    if (!is_finite_everywhere(state.position) || frame.failure() != StepFailure::None) break;
    passed.crossings = std::max(passed.crossings, crossings.count(state.position));
    ++passed.frames;
  }
  return passed;
}

class ContactCaseOf : public testing::TestWithParam<std::tuple<ContactCase, const Integrator*>> {};
// Each case with every method; the slow one every day with an explicit, an implicit and a constraint method.
auto combinations(bool is_daily) {
  std::vector<std::tuple<ContactCase, const Integrator*>> list;
  for (const ContactCase& each : cases_to_run())
    for (const Integrator* method : every_method()) {
      const bool is_quick =
          each.make != make_twisted_tube || method->id == "velocity_verlet" || method->id == "tr_bdf2" || method->id == "xpbd";
      if (is_quick == is_daily) list.emplace_back(each, method);
    }
  return list;
}
std::string name_of(const testing::TestParamInfo<std::tuple<ContactCase, const Integrator*>>& info) {
  return std::string(std::get<0>(info.param).name) + "_" + std::string(std::get<1>(info.param)->id);
}
INSTANTIATE_TEST_SUITE_P(Cases, ContactCaseOf, testing::ValuesIn(combinations(true)), name_of);
INSTANTIATE_TEST_SUITE_P(Nightly, ContactCaseOf, testing::ValuesIn(combinations(false)), name_of);

TEST_P(ContactCaseOf, LetsNothingPassThrough) {
  const auto& [each, method] = GetParam();
  const ContactScene scene = each.make();
  EXPECT_EQ(CrossingCounter(scene.network.system).count(scene.network.state.position), 0);
  const double seconds = is_full() ? std::min(scene.seconds, 5.0) : each.seconds;
  const Passed passed = run_and_count(scene, *method, seconds);
  EXPECT_GT(passed.frames, 0);
  EXPECT_EQ(passed.crossings, 0);
  EXPECT_EQ(passed.passages, 0);
}

// Without contact, things do pass through in these scenes.
TEST(ContactCases, AreNotEasy) {
  for (const ContactCase& each : contact_cases) {
    if (each.seconds == 0.0) continue;
    ContactScene scene = each.make();
    const bool has_springs = scene.network.system.contact.springs;
    if (scene.network.state.position.size() > 1000) continue;
    const CrossingCounter counter(scene.network.system);
    const PassageCounter passages(scene.network.system);
    TestSim sim{scene.network.system, scene.network.state};
    sim.system.contact = {};
    const Settings settings = settings_for(default_integrator(), scene);
    long worst = 0;
    for (int i = 0; i < 60.0 * std::min(scene.seconds, 0.6) && worst <= 10; ++i) {
      const std::vector<Vec3> before = sim.state.position;
      sim.run(default_integrator(), 1.0 / 60.0, settings.substeps);
      worst = has_springs ? worst + passages.count(before, sim.state.position) : std::max(worst, counter.count(sim.state.position));
    }
    EXPECT_GT(worst, 10) << each.name;
  }
}

// One spring moves through another, not quite as far, or past its ends.
TEST(PassageCounter, CountsSpringsThatMeet) {
  TestSim sim;
  sim.join(sim.add({-1.0, 0.0, 0.0}), sim.add({1.0, 0.0, 0.0}), 1.0, 2.0);
  sim.join(sim.add({0.3, 1.0, -1.0}), sim.add({0.2, 1.0, 1.0}), 1.0, 2.0);
  const PassageCounter counter(sim.system);
  const std::vector<Vec3> from = sim.state.position;
  const auto moved = [&](const Vec3& by) { return std::vector<Vec3>{from[0], from[1], from[2] + by, from[3] + by}; };
  EXPECT_EQ(counter.count(from, moved({0.0, -2.0, 0.0})), 1);
  EXPECT_EQ(counter.count(from, moved({0.0, -1.01, 0.0})), 1);
  EXPECT_EQ(counter.count(from, moved({0.0, -0.99, 0.0})), 0);
  EXPECT_EQ(counter.count(from, moved({4.0, -2.0, 0.0})), 0);
  EXPECT_EQ(counter.count(from, moved({0.0, -2.0, 4.0})), 0);
  EXPECT_EQ(counter.count(from, from), 0);
  // all four in a plane through the origin halfway
  EXPECT_EQ(counter.count({{-1.0, -0.5, 0.0}, {1.0, -0.5, 0.0}, {0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}},
                          {{-1.0, 0.5, 0.0}, {1.0, 0.5, 0.0}, {0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}}),
            1);
}

}  // namespace
}  // namespace hooke
