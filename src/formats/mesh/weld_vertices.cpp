#include "formats/mesh/weld_vertices.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

namespace hooke {
namespace {

// A grid of cubes with sides of four distances: everything within one distance of a position is in at most eight of them. Vertices that are
// kept are further apart than one distance, so the number of them in a cube is bounded.
class SpatialHash {
 public:
  SpatialHash(std::span<const Vec3> positions, double distance) : cell_size_(4.0 * distance) {
    keys_.reserve(positions.size());
    for (const Vec3& x : positions) keys_.push_back(key_at(x));
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    last_in_cell_.assign(keys_.size(), no_index);
    previous_in_cell_.assign(positions.size(), no_index);
  }

  void add(Index i, const Vec3& x) {
    Index& last = last_in_cell_[static_cast<std::size_t>(std::lower_bound(keys_.begin(), keys_.end(), key_at(x)) - keys_.begin())];
    previous_in_cell_[static_cast<std::size_t>(i)] = last;
    last = i;
  }

  // Calls visit(i) for each element of the cubes within `distance` of x.
  template <class Visit>
  void visit_near(const Vec3& x, double distance, Visit&& visit) const {
    std::array<std::uint64_t, 8> keys;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const Vec3 sign(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
      keys[corner] = key_at(x + distance * sign);
    }
    std::sort(keys.begin(), keys.end());
    const auto end = std::unique(keys.begin(), keys.end());
    for (auto key = keys.begin(); key != end; ++key) {
      const auto found = std::lower_bound(keys_.begin(), keys_.end(), *key);
      if (found == keys_.end() || *found != *key) continue;
      for (Index i = last_in_cell_[static_cast<std::size_t>(found - keys_.begin())]; i != no_index;
           i = previous_in_cell_[static_cast<std::size_t>(i)])
        visit(i);
    }
  }

 private:
  // A hash of the cube: two cubes with the same key are searched as one. The factors are those of Teschner and others, "Optimized spatial
  // hashing", 2003, the mixing is that of SplitMix64.
  std::uint64_t key_at(const Vec3& x) const {
    constexpr std::array<std::uint64_t, 3> factors{73856093, 19349663, 83492791};
    std::uint64_t key = 0;
    for (int c = 0; c < 3; ++c) {
      const double cell = cell_size_ > 0.0 ? std::floor(x[c] / cell_size_) : x[c];
      key ^= factors[static_cast<std::size_t>(c)] * std::bit_cast<std::uint64_t>(cell + 0.0);
      key = (key ^ key >> 30) * 0xbf58476d1ce4e5b9;
      key ^= key >> 27;
    }
    return key;
  }

  double cell_size_;
  std::vector<std::uint64_t> keys_;      // of the non-empty cubes, sorted
  std::vector<Index> last_in_cell_;      // added to each cube
  std::vector<Index> previous_in_cell_;  // the previous one in the same cube
};

}  // namespace

std::vector<Index> weld(std::span<const Vec3> positions, double distance) {
  SpatialHash hash(positions, distance);
  std::vector<Index> welded_to;
  welded_to.reserve(positions.size());
  for (Index i = 0; i < static_cast<Index>(positions.size()); ++i) {
    const Vec3& x = positions[static_cast<std::size_t>(i)];
    Index first = i;
    hash.visit_near(x, distance, [&](Index j) {
      if (j < first && glm::distance(positions[static_cast<std::size_t>(j)], x) <= distance) first = j;
    });
    welded_to.push_back(first);
    if (first == i) hash.add(i, x);
  }
  return welded_to;
}

}  // namespace hooke
