#include "study/check/copies.h"

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <utility>

namespace hooke {
namespace {

// More than that of the forecast in the window (forecast.h): a check may take longer.
constexpr Index max_points_of_forecast = 7'000;

}  // namespace

Scene scene_of(const System& system, const State& state, const Settings& settings) {
  Scene scene;
  scene.system = system;
  scene.state = state;
  scene.settings = settings;
  return scene;
}

Forecast forecast_of(const System& system, const State& state, const Part& part, const Forecast& before) {
  std::atomic<bool> stop = false;
  auto pending = std::async(std::launch::async, [&] {
    return make_forecast(std::make_shared<const System>(system), state, before, stop, max_points_of_forecast);
  });
  bool is_stopped = false;
  while (pending.wait_for(std::chrono::milliseconds(10)) != std::future_status::ready) {
    try {
      part.report(0.5);
    } catch (const Stopped&) {
      stop = is_stopped = true;
    }
  }
  if (is_stopped) throw Stopped{};
  return pending.get();
}

Scene resting_scene(const System& system, const State& state, const Settings& settings, const Forecast& forecast) {
  Scene scene = scene_of(system, state, settings);
  scene.system.grab.reset();
  scene.system.scripted_hand.reset();
  scene.system.colliders.clear();
  scene.system.wind = Vec3(0.0);
  scene.state.position = forecast.rest;
  std::ranges::fill(scene.state.velocity, Vec3(0.0));
  scene.state.hand = {};
  scene.state.memory = {};
  return scene;
}

std::optional<std::vector<Vec3>> settle(const System& system, const State& state, const Settings& settings, const Forecast& forecast,
                                        const Part& part) {
  constexpr double decay_times = 8.0, max_seconds = 20.0;
  Scene scene = resting_scene(system, state, settings, forecast);
  const double omega = forecast.slowest->omega;
  scene.system.drag = std::max(scene.system.drag_rate(), 2.0 * omega);
  scene.system.switches.drag = true;
  Lab lab(std::move(scene), KeepStart::No);
  if (!run_frames(lab, std::min(decay_times / omega, max_seconds), part, [](const Scene&) {})) return std::nullopt;
  return lab.scene().state.position;
}

}  // namespace hooke
