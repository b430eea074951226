// The effect of each command on a scene, called by `apply` (edit/apply.h). One file for each group of commands.
#pragma once

#include <cmath>
#include <vector>

#include "edit/apply.h"

namespace hooke {

using Inverse = std::vector<Command>;

struct Apply {
  Scene& scene;
  Effect& effect;

  // network.cpp: points, springs and faces are added and removed
  Inverse operator()(const Insert& insert);
  Inverse operator()(const Remove& remove);

  // properties.cpp: properties of points and springs
  Inverse operator()(const SetNailed& set);
  Inverse operator()(const Move& move);
  Inverse operator()(const SetPointColor& set);
  Inverse operator()(const SetPointProperty& set);
  Inverse operator()(const SetSpringProperty& set);

  // settings.cpp: parameters, method, environment, appearance
  Inverse operator()(const SetParameter& set);
  Inverse operator()(const RestoreParameter& restore);
  Inverse operator()(const SetIntegrator& set);
  Inverse operator()(const SetGravity& set);
  Inverse operator()(const SetColliders& set);
  Inverse operator()(const SetForces& set);
  Inverse operator()(const SetTexture& set);

  // hand.cpp: grab, move, release
  Inverse operator()(const GrabPoint& grab);
  Inverse operator()(const GrabCollider& grab);
  Inverse operator()(const MoveHand& move);
  Inverse operator()(const ReleaseHand&);

  // states.cpp: other states of the run, other scenes
  Inverse operator()(const GoToState& go);
  Inverse operator()(const SetTorn& set);
  Inverse operator()(const MarkTorn& mark);
  Inverse operator()(const Replace& replace);

 private:
  Inverse inverse_of(const Parameter& parameter) const;
  Inverse apply_tears_until(std::uint32_t torn);
  void release_collider();
};

// Whether a value may be part of a scene.
inline bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool is_valid(const Point& point);
bool is_valid(const Spring& spring);

// The points that a grab acts on.
std::vector<PointId> points_of(const Grab& grab);

// Projects to the plane of a two-dimensional scene.
inline Vec3 in_plane(const System& system, Vec3 v) {
  if (system.dimensions == 2) v.z = 0.0;
  return v;
}

}  // namespace hooke
