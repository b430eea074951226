#include "sim/plan/numbering/point_order.h"

#include <algorithm>
#include <cstdlib>

#include "sim/plan/constants.h"
#include "sim/plan/numbering/cuthill_mckee.h"
#include "sim/plan/numbering/lattices.h"

namespace hooke {
namespace {

// Springs along the threads of a cloth, and all others that may be that.
std::vector<EdgeEnds> thread_ends(const System& system, std::span<const EdgeEnds> ends) {
  std::vector<EdgeEnds> threads;
  threads.reserve(ends.size());
  for (std::size_t s = 0; s < ends.size(); ++s)
    if (const SpringFamily family = system.springs()[s].family; family == SpringFamily::None || family == SpringFamily::Structural)
      threads.push_back(ends[s]);
  return threads;
}

struct FoundOrder {
  std::vector<Index> points;  // of the System
  double in_lattices = 0.0;   // [1], part of the points
};

FoundOrder find_order(const System& system, std::span<const EdgeEnds> ends) {
  const Index points = system.point_count();
  FoundOrder found;
  std::vector<Index>& order = found.points;
  order.reserve(static_cast<std::size_t>(points));
  std::vector<char> done(static_cast<std::size_t>(points), 0);
  for (const LatticePoints& lattice : find_lattices({points, thread_ends(system, ends)}))
    for (const Index i : lattice) {
      order.push_back(i);
      done[i] = 1;
    }
  found.in_lattices = static_cast<double>(order.size()) / points;
  if (static_cast<Index>(order.size()) < points) append_near_neighbors({points, ends}, done, order);
  return found;
}

}  // namespace

OrderQuality measure_order(Index points, std::span<const EdgeEnds> ends, std::span<const Index> number) {
  if (ends.empty()) return {};
  std::vector<Index> count(static_cast<std::size_t>(points), 0);  // of springs, by the difference of the numbers
  double sum = 0.0;
  for (const auto& [i, j] : ends) {
    const Index apart = number.empty() ? std::abs(i - j) : std::abs(number[i] - number[j]);
    ++count[apart];
    sum += apart;
  }
  // in a random order, the most frequent difference occurs twice per spring of a point
  const double frequent = 16.0 + 4.0 * static_cast<double>(ends.size()) / points;
  double regular = 0.0;
  for (const Index springs : count) regular += springs >= frequent ? springs : 0;
  return {regular / static_cast<double>(ends.size()), sum / static_cast<double>(ends.size())};
}

std::vector<Index> choose_point_order(const System& system, std::span<const EdgeEnds> ends) {
  const Index points = system.point_count();
  const OrderQuality listed = measure_order(points, ends, {});
  if (listed.regular >= regular_enough) return {};
  FoundOrder found = find_order(system, ends);
  std::vector<Index> number(found.points.size());
  for (Index i = 0; i < points; ++i) number[found.points[i]] = i;
  const OrderQuality quality = measure_order(points, ends, number);

  const bool has_nets = found.in_lattices >= min_in_lattices && quality.regular >= listed.regular + min_regular_gain;
  const bool has_ropes = quality.regular >= regular_as_ropes;
  // in smaller scenes all points are in a fast cache, in any order
  const bool is_local = listed.distance > far_apart && quality.distance < min_approach * listed.distance;
  if (has_nets || has_ropes || is_local) return std::move(found.points);
  return {};
}

}  // namespace hooke
