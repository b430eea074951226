// The parts of the scene that an edit in a panel affects, and the values that they share. Panels are built every frame and a scene can
// have hundreds of thousands of springs, so this is computed only when the scene or the selection has changed.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "lab/status.h"
#include "scene/parameters.h"
#include "scene/selection.h"

namespace hooke {

// The value of the first item, and whether others differ from it.
template <class Value>
struct Common {
  Value value{};
  bool mixed = false;
};

template <class Item, class Read>
auto common(const std::vector<Item>& items, const Read& read) {
  Common<std::decay_t<decltype(read(items.front()))>> found;
  if (items.empty()) return found;
  found.value = read(items.front());
  found.mixed = std::ranges::any_of(items, [&](const Item& item) { return !(read(item) == found.value); });
  return found;
}

struct AffectedParts {
  // Indices of the selected points, and of the springs that are selected or between selected points.
  std::vector<Index> points, springs;

  // Of these.
  Common<bool> nailed;
  Common<std::optional<Color>> color;
  Common<double> mass, radius;
  Common<double> stiffness, damping, rest_length, break_strain;

  // The value of each row of parameters() that sets springs, over `springs`, or over all springs if there are none; empty: it sets none.
  std::vector<CommonValue> slider_values;
};

class AffectedPartsCache {
 public:
  const AffectedParts& of(const Status& status, const Selection& selection);

  // How often the parts were computed, for tests.
  long computations() const { return computations_; }

 private:
  AffectedParts parts_;
  // what they were computed from; both objects are replaced by every edit
  std::shared_ptr<const System> system_;
  std::shared_ptr<const DocumentStatus> document_;
  Selection selection_;
  long computations_ = 0;
};

// Whether the row sets a property of springs.
bool sets_springs(const Parameter& row);

// Calls `visit(spring)` with each spring that a slider sets: those of the selection if it has any, else all.
template <class Visit>
void for_each_affected(const System& system, const AffectedParts& parts, const Visit& visit) {
  if (parts.springs.empty())
    for (const Spring& spring : system.springs()) visit(spring);
  for (const Index s : parts.springs) visit(system.springs()[s]);
}

}  // namespace hooke
