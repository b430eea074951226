#include <algorithm>

#include "lab/edits/edits.h"
#include "lab/tears.h"

namespace hooke {

// The time moves with the points: it is another moment of the same run.
Inverse Apply::operator()(const GoToState& go) {
  const State& there = *go.state;
  const auto fits = [&](const std::vector<Vec3>& list) {
    return list.size() == scene.system.points().size() && std::ranges::all_of(list, is_finite);
  };
  if (!fits(there.position) || !fits(there.velocity) || !std::isfinite(there.time) || there.torn > scene.tears.size()) return {};
  const GoToState inverse{std::make_shared<const State>(scene.state)};
  const EnergyLedger ledger = scene.state.ledger;
  make_torn(there.torn);
  scene.state = there;
  scene.state.ledger = ledger;
  scene.system.grab.reset();
  effect.values = true;
  return {inverse};
}

Inverse Apply::operator()(const SetTorn& set) {
  if (set.torn > scene.tears.size()) return {};
  const SetTorn inverse{scene.state.torn};
  make_torn(set.torn);
  return {inverse};
}

// Mends and tears what lies between.
void Apply::make_torn(std::uint32_t torn) {
  const TearPath path = path_between(scene, scene.state.torn, torn);
  for (const std::uint32_t tear : path.mended) (*this)(mending_of(*scene.tears[tear - 1]));
  for (const std::uint32_t tear : path.torn) (*this)(tearing_of(*scene.tears[tear - 1]));
  scene.state.torn = torn;
}

Inverse Apply::operator()(const Replace& replace) {
  const Replace inverse{std::make_shared<const Scene>(scene)};
  // tears of the same run stay known: what came of them may be gone back to
  auto tears = std::move(scene.tears);
  scene = *replace.scene;
  const bool goes_on = tears.size() > scene.tears.size() && std::equal(scene.tears.begin(), scene.tears.end(), tears.begin());
  if (goes_on) scene.tears = std::move(tears);
  effect.structure = true;
  return {inverse};
}

}  // namespace hooke
