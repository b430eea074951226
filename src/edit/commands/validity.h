// What may be part of a scene: the same as the reader of scene files accepts.
#pragma once

#include "edit/commands/settings.h"

namespace hooke {

bool is_valid(const Point& point);
bool is_valid(const Spring& spring);
bool is_valid(const Face& face);
bool is_valid(const Collider& collider);
bool is_valid(const PairContact& contact);
bool is_valid(const Force& force);
bool is_valid(const SetTexture& set);
bool is_valid(const Parameter& parameter, double value);
// What the parameter sets, after it was set: a value within its own limits may still give a spring no finite stiffness.
bool is_valid_after(const Parameter& parameter, const Scene& scene);

}  // namespace hooke
