// The start of a run, to which "Back to start" leads. What was edited since then stays: structure and parameters. What the run did, and
// the hand in it, does not: positions, velocities, tears, gas that has leaked, released nails, moved colliders and the time.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "edit/command.h"
#include "sim/forces/terms/gas_leak.h"

namespace hooke {

class Start {
 public:
  // The start of another document.
  void open(std::shared_ptr<const Scene> scene) {
    set(scene);
    opened_ = std::move(scene);
  }
  void set(std::shared_ptr<const Scene> scene);
  // Edits made before the first frame belong to the start: records one, and takes `scene` as the start if there were any.
  void record_edit() { is_edited_ = true; }
  void keep_edits(const Scene& scene);
  // Null: none is kept.
  const std::shared_ptr<const Scene>& scene() const { return scene_; }
  // As the document was opened; null: none is kept.
  const std::shared_ptr<const Scene>& opened() const { return opened_; }

  // Records points added since then: they start where they were put.
  void record_added(const Insert& insert);
  // Records nails that are released only for the run; nails that are set again, or all of them.
  void record_release(const SetNailed& release);
  void forget_release(PointId point) { released_.erase(point); }
  void forget_releases() { released_.clear(); }
  bool is_released(PointId point) const { return released_.contains(point); }
  // Records leaks of gas that are changed in the run, from the forces `now` to those after it.
  void record_leaks(const std::vector<Force>& now, const std::vector<Force>& after);
  // Whether a point is nailed at the start.
  bool is_nailed(PointId point) const;

  // The scene `now`, back at the start.
  Scene return_from(const Scene& now) const;

 private:
  // Sets it with the nails that were released only for the run.
  void set_with_released_nails(Scene scene);

  struct Place {
    Vec3 position, velocity;  // [m], [m/s]
  };
  std::shared_ptr<const Scene> scene_, opened_;
  bool is_edited_ = false;  // since it was set
  std::map<PointId, Place> added_;
  std::set<PointId> released_;
  std::vector<LeakChange> leaks_;
};

}  // namespace hooke
