#include <algorithm>
#include <cmath>

#include "base/bounds.h"
#include "base/finite.h"
#include "edit/command.h"
#include "edit/in_plane.h"
#include "edit/tears.h"
#include "sim/control/automatic.h"

namespace hooke {
namespace {

// Undoes and repeats the tears between the current index and `torn`. Springs may have changed since they were restored: the inverse
// restores what is removed here as it is.
Inverse apply_tears_until(std::uint32_t torn, Scene& scene, Effect& effect) {
  const TearPath path = path_between(scene, scene.state.torn, torn);
  if (path.empty()) return {};
  Inverse inverse{MarkTorn{scene.state.torn}};
  const auto put_first = [&](const Inverse& step) { inverse.insert(inverse.begin(), step.begin(), step.end()); };
  for (const std::uint32_t tear : path.undone) put_first(restored_by_undo(*scene.tears[tear - 1]).apply(scene, effect));
  for (const std::uint32_t tear : path.torn) put_first(removal_of_tear(*scene.tears[tear - 1]).apply(scene, effect));
  scene.state.torn = torn;
  return inverse;
}

}  // namespace

std::string GoToState::describe() const { return "go to " + format_exact(std::round(1000.0 * state->time) / 1000.0) + " s"; }

// The time changes with the points: it is another state of the same run.
Inverse GoToState::apply(Scene& scene, Effect& effect) const {
  const State& target = *state;
  const auto fits = [&](const std::vector<Vec3>& list) {
    return list.size() == scene.system.points().size() && std::ranges::all_of(list, [](const Vec3& v) { return is_finite(v); });
  };
  if (!fits(target.position) || !fits(target.velocity) || !std::isfinite(target.time) || target.torn > scene.tears.size()) return {};
  if (!is_finite(target.hand.position) || !is_finite(target.hand.target) || !is_valid(target.memory)) return {};
  const GoToState before{std::make_shared<const State>(scene.state)};
  // the supply and a carried collider belong to the present
  const EnergySupply supply = scene.state.supply;
  const std::optional<CarriedCollider> carried = scene.state.hand.collider;
  Inverse inverse = apply_tears_until(target.torn, scene, effect);
  inverse.push_back(before);
  scene.state = target;
  for (std::vector<Vec3>* list : {&scene.state.position, &scene.state.velocity})
    for (Vec3& v : *list) v = in_plane(scene.system, v);
  scene.state.supply = supply;
  scene.state.hand.collider = carried;
  scene.system.grab.reset();
  effect.values = effect.motion = true;
  return inverse;
}

Inverse SetTorn::apply(Scene& scene, Effect& effect) const {
  if (torn > scene.tears.size()) return {};
  return apply_tears_until(torn, scene, effect);
}

Inverse MarkTorn::apply(Scene& scene, Effect&) const {
  if (torn > scene.tears.size()) return {};
  const MarkTorn inverse{scene.state.torn};
  scene.state.torn = torn;
  return {inverse};
}

Inverse Replace::apply(Scene& current, Effect& effect) const {
  const Replace inverse{std::make_shared<const Scene>(current)};
  // keep the tears of the same run: later states of it can still be returned to
  auto tears = std::move(current.tears);
  current = *scene;
  const bool is_same_run = tears.size() > current.tears.size() && std::equal(current.tears.begin(), current.tears.end(), tears.begin());
  if (is_same_run) current.tears = std::move(tears);
  effect.structure = true;
  return {inverse};
}

}  // namespace hooke
