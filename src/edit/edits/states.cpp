#include <algorithm>

#include "edit/edits/edits.h"
#include "edit/tears.h"

namespace hooke {

// The time changes with the points: it is another state of the same run.
Inverse Apply::operator()(const GoToState& go) {
  const State& target = *go.state;
  const auto fits = [&](const std::vector<Vec3>& list) {
    return list.size() == scene.system.points().size() && std::ranges::all_of(list, is_finite);
  };
  if (!fits(target.position) || !fits(target.velocity) || !std::isfinite(target.time) || target.torn > scene.tears.size()) return {};
  const GoToState before{std::make_shared<const State>(scene.state)};
  // the ledger and a carried collider belong to the present
  const EnergyLedger ledger = scene.state.ledger;
  const std::optional<CarriedCollider> carried = scene.state.hand.collider;
  Inverse inverse = apply_tears_until(target.torn);
  inverse.push_back(before);
  scene.state = target;
  scene.state.ledger = ledger;
  scene.state.hand.collider = carried;
  scene.system.grab.reset();
  effect.values = true;
  return inverse;
}

Inverse Apply::operator()(const SetTorn& set) {
  if (set.torn > scene.tears.size()) return {};
  return apply_tears_until(set.torn);
}

Inverse Apply::operator()(const MarkTorn& mark) {
  const MarkTorn inverse{scene.state.torn};
  scene.state.torn = mark.torn;
  return {inverse};
}

// Undoes and repeats the tears between the current index and `torn`. Springs may have changed since they were restored: the inverse
// restores what is removed here as it is.
Inverse Apply::apply_tears_until(std::uint32_t torn) {
  const TearPath path = path_between(scene, scene.state.torn, torn);
  if (path.empty()) return {};
  Inverse inverse{MarkTorn{scene.state.torn}};
  const auto put_first = [&](const Inverse& step) { inverse.insert(inverse.begin(), step.begin(), step.end()); };
  for (const std::uint32_t tear : path.undone) put_first((*this)(restored_by_undo(*scene.tears[tear - 1])));
  for (const std::uint32_t tear : path.torn) put_first((*this)(removal_of_tear(*scene.tears[tear - 1])));
  scene.state.torn = torn;
  return inverse;
}

Inverse Apply::operator()(const Replace& replace) {
  const Replace inverse{std::make_shared<const Scene>(scene)};
  // keep the tears of the same run: later states of it can still be returned to
  auto tears = std::move(scene.tears);
  scene = *replace.scene;
  const bool is_same_run = tears.size() > scene.tears.size() && std::equal(scene.tears.begin(), scene.tears.end(), tears.begin());
  if (is_same_run) scene.tears = std::move(tears);
  effect.structure = true;
  return {inverse};
}

}  // namespace hooke
