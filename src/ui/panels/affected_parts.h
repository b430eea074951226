// The parts of the scene that an edit in a panel affects, and the values that they share. Panels are built every frame and a scene can
// have hundreds of thousands of springs, so this is computed only when the scene or the selection has changed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "lab/status.h"
#include "scene/parameters.h"
#include "scene/selection.h"
#include "ui/panels/mixed_values.h"

namespace hooke {

// The value that all items have, or the mean of numbers that differ.
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
  if constexpr (std::is_floating_point_v<decltype(found.value)>) {
    if (!found.mixed) return found;
    found.value = 0.0;
    double largest = 0.0;
    for (const Item& item : items) {
      found.value += read(item) / static_cast<double>(items.size());
      largest = std::max(largest, std::abs(read(item)));
    }
    // the rest of a sum that is zero but for round-off
    if (std::abs(found.value) < 1e-12 * largest) found.value = 0.0;
  }
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

  // The springs that sliders set: those above, else all.
  AffectedSprings slider_springs;
  // The values that each row of parameters() sets in springs, points or colliders; empty where it sets a value of the scene.
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

}  // namespace hooke
