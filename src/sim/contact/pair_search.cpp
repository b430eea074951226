#include "sim/contact/pair_search.h"

#include <algorithm>
#include <cmath>

namespace hooke {
namespace {

// The number of a cell along one axis. Far away, cells are merged.
std::int64_t cell_of(double x, double width) {
  constexpr double max = 1e15;
  return std::isfinite(x) ? static_cast<std::int64_t>(std::clamp(std::floor(x / width), -max, max)) : 0;
}

double distance_squared(const Plan& plan, const Field& x, Index i, Index j) {
  double sum = 0.0;
  for (int c = 0; c < plan.dimensions; ++c) {
    const auto at = static_cast<std::size_t>(c) * plan.points;
    const double d = x[at + i] - x[at + j];
    sum += d * d;
  }
  return sum;
}

}  // namespace

void PairSearch::sort_into_cells(const Plan& plan, const Field& x, std::span<const double> extent, double max_extent, double width) {
  const auto n = static_cast<std::size_t>(plan.points);
  cells_.clear();
  large_.clear();
  for (Index i = 0; i < plan.points; ++i) {
    const double z = plan.dimensions == 3 ? x[2 * n + i] : 0.0;
    if (extent[i] <= max_extent)
      cells_.push_back({cell_of(z, width), cell_of(x[n + i], width), cell_of(x[i], width), i});
    else
      large_.push_back(i);
  }
  std::ranges::sort(cells_);
}

bool PairSearch::find(const Plan& plan, const Field& x, std::span<const double> extent, std::vector<PointPair>& pairs,
                      std::size_t max_pairs) {
  pairs.clear();
  if (plan.points < 2) return true;
  extents_.assign(extent.begin(), extent.end());
  const auto most = extents_.begin() + static_cast<std::ptrdiff_t>(extents_.size() * 9 / 10);
  std::nth_element(extents_.begin(), most, extents_.end());
  const double max_extent = *most, width = max_extent > 0.0 ? 2.0 * max_extent : 1.0;
  sort_into_cells(plan, x, extent, max_extent, width);

  bool is_complete = true;
  const auto add = [&](Index a, Index b) {
    const PointPair pair{std::min(a, b), std::max(a, b)};
    const double reach = extent[a] + extent[b];
    if (distance_squared(plan, x, a, b) > reach * reach) return;
    if ((plan.inverse_mass_in_contact()[a] == 0.0 && plan.inverse_mass_in_contact()[b] == 0.0) || plan.pairs.excludes(pair.i, pair.j))
      return;
    if (pairs.size() < max_pairs)
      pairs.push_back(pair);
    else
      is_complete = false;
  };

  // the cells next to each other along x are consecutive
  const int depth = plan.dimensions == 3 ? 1 : 0;
  for (const Cell& cell : cells_) {
    if (!is_complete) return false;
    for (int dz = -depth; dz <= depth; ++dz)
      for (int dy = -1; dy <= 1; ++dy) {
        const Cell first{cell.z + dz, cell.y + dy, cell.x - 1, -1};
        for (auto other = std::ranges::lower_bound(cells_, first); other != cells_.end(); ++other) {
          if (other->z != first.z || other->y != first.y || other->x > cell.x + 1) break;
          if (other->point > cell.point) add(cell.point, other->point);
        }
      }
  }
  for (std::size_t l = 0; l < large_.size() && is_complete; ++l) {
    for (const Cell& cell : cells_) add(large_[l], cell.point);
    for (std::size_t other = l + 1; other < large_.size(); ++other) add(large_[l], large_[other]);
  }
  std::ranges::sort(pairs);
  return is_complete;
}

}  // namespace hooke
