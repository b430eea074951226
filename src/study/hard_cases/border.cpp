// Limits of the laboratory: shipped scenes, input files, the clock, threads.
#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "base/errors.h"
#include "formats/scene_file.h"
#include "sim/methods/rows.h"
#include "sim/model/hash.h"
#include "sim/step/divergence.h"
#include "study/analytic_scenes.h"
#include "study/hard_cases/monitored_run.h"
#include "study/hard_cases/rows.h"

namespace hooke {
namespace {

Verdict judge_one_substep(const Integrator& method) {
  // every shipped scene for a second: it finishes or is stopped with a report
  int held = 0, all = 0;
  std::vector<Verdict> parts;
  for (const ShippedScene& shipped : shipped_scenes()) {
    const Scene scene = load_scene(shipped.file).scene;
    MonitoredRun run({scene.system, scene.state}, {.integrator = &method, .substeps = 1});
    run.run(1.0);
    parts.push_back(judge(run, is_finite(run.state()), ""));
    if (parts.back().outcome == Outcome::FailedOpenly) parts.back().reason = shipped.id + ": " + parts.back().reason;
    held += run.stopped() ? 0 : 1;
    ++all;
  }
  if (parts.empty()) throw FileError((assets_folder() / "scenes").string() + ": no scenes found");
  Verdict verdict = worst_of(parts);
  verdict.measured = formatted("%d of %d scenes finish", held, all);
  return verdict;
}

constexpr std::string_view invalid_scenes[] = {
    R"({"hooke": 1, "points": [{"position": [0, NaN, 0]}]})",
    R"({"hooke": 1, "points": [{"position": [0, 1e400, 0]}]})",
    R"({"hooke": 1, "points": [{"position": [0, 0, 0], "velocity": [-Infinity, 0, 0]}]})",
    R"({"hooke": 1, "points": [{"position": [0, 0, 0], "mass": 0}]})",
    R"({"hooke": 1, "points": [{"position": [0, 0, 0], "mass": -1}]})",
    R"({"hooke": 1, "points": [{"position": [0, 0, 0], "mass": NaN}]})",
    R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}], "springs": [{"points": [0, 1], "stiffness": -1}]})",
    R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}], "springs": [{"points": [0, 1], "stiffness": 1e999}]})",
    R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}], "springs": [{"points": [0, 1], "damping": -0.5}]})",
    R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}], "springs": [{"points": [0, 1], "rest_length": -1}]})",
    R"({"hooke": 1, "points": [{"position": [0, 0, 0]}], "springs": [{"points": [0, 0]}]})",
    R"({"hooke": 1, "points": [{"position": [0, 0, 0]}], "springs": [{"points": [0, 7]}]})",
    R"({"hooke": 1, "drag": -1})",
    R"({"hooke": 1, "gravity": [0, -1e309, 0]})",
    R"({"hooke": 1, "points": [{"position": [0, 0, 0], "mass": 1e-310}]})",
    R"({"hooke": 1, "simulation": {"frame_rate": 0}})",
    R"({"hooke": 1, "simulation": {"substeps": 0}})",
    R"({"hooke": 1, "simulation": {"tolerance": -1}})",
};

// The number of invalid scenes that are accepted, or refused without a message.
int count_accepted() {
  int accepted = 0;
  for (const std::string_view text : invalid_scenes) {
    try {
      parse_scene(text, "bad.json");
      ++accepted;
    } catch (const InputError& refused) {
      if (std::string_view(refused.what()).size() < 20) ++accepted;
    }
  }
  return accepted;
}

// Six points and ten springs with any values that a file may contain, from the smallest numbers to the largest.
TestNetwork make_extreme(Random& random, double decades) {
  const auto size = [&] { return std::pow(10.0, random.uniform(-decades, decades)); };
  TestNetwork network;
  network.system.gravity = random.vector(size());
  network.system.drag = random.next_bits() % 2 == 0 ? 0.0 : size();
  const double extent = size(), speed = size();
  for (int i = 0; i < 6; ++i) network.add(random.vector(extent), size(), random.vector(speed));
  network.system.point(0).nailed = true;
  network.state.velocity[0] = Vec3(0.0);
  for (int i = 0; i < 10; ++i) {
    const auto first = static_cast<Index>(random.next_bits() % 6), second = static_cast<Index>((first + 1 + random.next_bits() % 5) % 6);
    const double damping = random.next_bits() % 2 == 0 ? 0.0 : size();
    network.join(network.system.points()[first].id, network.system.points()[second].id, size(), size(), damping);
  }
  return network;
}

Verdict judge_bad_input(const Integrator& method) {
  const int accepted = count_accepted();

  // an adaptive method would take an unlimited number of steps
  const double decades = method.stability == Stability::Adaptive ? 2.0 : 100.0;
  constexpr int sets = 300;
  int stopped = 0, silent = 0;
  std::string reason;
  for (int seed = 0; seed < sets; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    MonitoredRun run(make_extreme(random, decades * (seed + 1) / sets), {.integrator = &method, .substeps = 4});
    run.run(0.2);
    const bool named = !run.stopped() || !run.report().empty();
    if (!named || !is_finite(run.state())) ++silent;
    if (run.stopped()) ++stopped;
  }
  return {
      .outcome = accepted == 0 && silent == 0 ? Outcome::Held : Outcome::FailedSilently,
      .measured = formatted("%zu invalid scenes: %d accepted; %d extreme ones: %d stopped by the divergence check, %d silently not finite",
                            std::size(invalid_scenes), accepted, sets, stopped, silent)};
}

// The window is hidden for ten seconds: the run resumes where it was and continues as if nothing had happened.
Verdict judge_hidden_window(const Integrator& method) {
  const InitialState net = make_net(8, 1e2, 0.0);
  MonitoredRun run({net.system, net.state}, {.integrator = &method, .substeps = 20});
  Lab& lab = run.lab();
  lab.submit(SetRunning{true});
  const auto frames_after = [&](double seconds, bool in_time) {
    const long before = lab.status()->run.frames;
    lab.advance(seconds, [&] { return in_time; });
    return lab.status()->run.frames - before;
  };
  const long jump = frames_after(10.0, true), next = frames_after(1.0 / 60.0, true);
  // too slow for real time: one substep per call, so that a frame takes twenty calls
  long slow = 0;
  for (int i = 0; i < 40; ++i) slow += frames_after(0.1, false);
  const double shown = lab.status()->run.speed;
  // `auto` computes some frames at once, and some methods several substeps
  const bool is_slow = is_automatic(run.settings()) || method.steps != nullptr || slow <= 2;
  return judge(run, Expectation::Hold, jump <= 16 && next <= 2 && is_slow && shown < 0.5,
               formatted("%ld frames after 10 s, %ld after the next 60th; too slow: shows %.2g of real time", jump, next, shown));
}

Verdict judge_determinism(const Integrator& method) {
  const InitialState curtain = make_curtain(8, 1e3, 0.1);
  const auto hash = [&] {
    MonitoredRun run({curtain.system, curtain.state}, {.integrator = &method, .substeps = 20});
    run.run(0.5);
    return hash_state(run.state());
  };
  std::array<std::uint64_t, 3> hashes{};
  hashes[0] = hash();
  std::thread first([&] { hashes[1] = hash(); }), second([&] { hashes[2] = hash(); });
  first.join();
  second.join();
  const bool same = hashes[0] == hashes[1] && hashes[0] == hashes[2];
  return {.outcome = same ? Outcome::Held : Outcome::FailedSilently,
          .measured = formatted("hash %016llx", static_cast<unsigned long long>(hashes[0]))};
}

}  // namespace

constinit const HardCase one_substep_case{
    .number = 10,
    .name = "One substep per frame",
    .parameters = "every shipped scene, one step of 1/60 s per frame, 1 s",
    .criterion = "finite to the end where the method declares that step stable; otherwise the divergence check may stop it",
    .slow_under = method_list<dop853, implicit_euler, baraff_witkin, implicit_midpoint, tr_bdf2, esdirk4>,
    .judge = judge_one_substep,
};

constinit const HardCase bad_input_case{
    .number = 15,
    .name = "Invalid input",
    .parameters =
        "NaN, Inf, 1e400, denormal and negative masses, k, d, l0 < 0, rates of 0 in files; 300 small scenes with accepted values from "
        "1e-100 to 1e100",
    .criterion = "refused with a message; accepted scenes stay finite or are stopped by the divergence check",
    .remark = "dop853 would resolve every oscillation of the fastest of these springs, so it gets values from 1e-2 to 1e2",
    .slow_under = method_list<esdirk4>,
    .judge = judge_bad_input,
};

constinit const HardCase hidden_window_case{
    .number = 24,
    .name = "Hidden window",
    .parameters = "10 s without a frame, and a machine too slow for the scene",
    .criterion = "one short jump, no catching up, and the reduced speed is shown",
    .judge = judge_hidden_window,
};

constinit const HardCase determinism_case{
    .number = 27,
    .name = "Determinism",
    .parameters = "curtain of 8 x 8, 0.5 s, alone and twice at the same time on two threads",
    .criterion = "identical bits",
    .remark = "here a scene is stepped on one thread; the tests compare the bits of 1, 2, 3, 5 and 16 threads in one scene",
    .judge = judge_determinism,
};

}  // namespace hooke
