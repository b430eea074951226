// Random edits of every kind for any scene, with plausible and invalid values.
#pragma once

#include <vector>

#include "edit/command.h"
#include "lab/lab.h"
#include "support/random_scene.h"

namespace hooke {

class RandomCommands {
 public:
  explicit RandomCommands(std::uint64_t seed) : random_(seed) {}
  // Any command except MarkTorn and Replace, which only follow from others. New points and springs take their ids from the lab.
  Command next(Lab& lab);
  static constexpr std::size_t kinds = std::variant_size_v<CommandVariant> - 2;
  Random& random() { return random_; }

 private:
  double number();  // a plausible one or, rarely, one that no property may have
  Vec3 vector();
  PointId point(const Scene& scene);
  SpringId spring(const Scene& scene);
  std::vector<PointId> some_points(const Scene& scene);
  std::vector<SpringId> some_springs(const Scene& scene);
  Insert insert(Lab& lab);
  Remove remove(const Scene& scene);
  GrabPoint grab(const Scene& scene);
  SetColliders colliders(const Scene& scene);
  SetForces forces();
  GoToState go_to(const Scene& scene);

  Random random_;
};

}  // namespace hooke
