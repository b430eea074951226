#include "lab/start.h"

#include <algorithm>

#include "edit/command.h"

namespace hooke {

void Start::set(std::shared_ptr<const Scene> scene) {
  scene_ = std::move(scene);
  added_.clear();
  released_.clear();
  leaks_.clear();
  is_edited_ = false;
}

void Start::keep_edits(const Scene& scene) {
  if (is_edited_ && scene.state.time == scene_->state.time) set_with_released_nails(scene);
  is_edited_ = false;
}

void Start::set_with_released_nails(Scene scene) {
  for (const PointId id : released_)
    if (const Index i = scene.system.index_of(id); i != no_index) scene.system.point(i).nailed = true;
  scene_ = std::make_shared<const Scene>(std::move(scene));
  added_.clear();
}

void Start::record_added(const Insert& insert) {
  for (const PlacedPoint& placed : insert.points) added_.insert_or_assign(placed.point.id, Place{placed.position, placed.velocity});
}

void Start::record_release(const SetNailed& release) {
  for (const SetNailed::Item& item : release.items) released_.insert(item.point);
}

void Start::record_leaks(const std::vector<Force>& now, const std::vector<Force>& after) {
  for (std::size_t f = 0; f < std::min(now.size(), after.size()); ++f)
    if (is_leak_continued(now[f], after[f])) leaks_.push_back({now[f], after[f]});
}

bool Start::is_nailed(PointId point) const {
  if (released_.contains(point)) return true;
  if (!scene_) return false;
  const Index i = scene_->system.index_of(point);
  return i != no_index && scene_->system.points()[i].nailed;
}

Scene Start::return_from(const Scene& now) const {
  const System& start = scene_->system;
  Scene scene = now;
  State state = scene_->state;
  state.position = now.state.position;
  state.velocity = now.state.velocity;
  for (Index i = 0; i < now.system.point_count(); ++i) {
    const PointId id = now.system.points()[i].id;
    if (const Index s = start.index_of(id); s != no_index) {
      state.position[i] = scene_->state.position[s];
      state.velocity[i] = scene_->state.velocity[s];
    } else if (const auto added = added_.find(id); added != added_.end()) {
      state.position[i] = added->second.position;
      state.velocity[i] = added->second.velocity;
    }
  }
  scene.state.hand = {};
  // muscles and winches at the phase of the start
  scene.system.muscles.offset = start.muscles.at(scene_->state.time) - scene.system.muscles.rate() * scene_->state.time;
  Effect effect;
  apply(scene, GoToState{std::make_shared<const State>(std::move(state))}, effect);
  for (Index i = 0; i < scene.system.point_count(); ++i)
    if (is_nailed(scene.system.points()[i].id)) scene.system.point(i).nailed = true;
  for (Force& force : scene.system.forces) force = before_leaks(force, scene_->state.time, leaks_);
  if (scene.system.colliders.size() == start.colliders.size())
    for (std::size_t c = 0; c < start.colliders.size(); ++c) scene.system.colliders[c].shape = start.colliders[c].shape;
  return scene;
}

}  // namespace hooke
