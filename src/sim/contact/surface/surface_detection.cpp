#include "sim/contact/surface/surface_detection.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/constants.h"

namespace hooke {
namespace {

constexpr std::size_t block_size = FeatureBlock::capacity;

// [m] or [m/s], the largest difference of one of these vectors from their mean.
template <class Vector>
double max_deviation(std::size_t count, const Vector& vector) {
  Vec3 sum(0.0);
  for (std::size_t k = 0; k < count; ++k) sum += vector(k);
  const Vec3 mean = sum / static_cast<double>(count);
  double max = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 difference = vector(k) - mean;
    max = std::max(max, glm::dot(difference, difference));
  }
  return std::sqrt(max);
}

}  // namespace

void SurfaceDetection::begin_frame(const SurfacePlan& plan, std::span<const Vec3> x) {
  tree_.build(plan, x);
  left_out_.clear();
  const std::vector<Crossing> crossings = tree_.find_crossings(plan, x).found;
  crossings_ = static_cast<long>(crossings.size());
  for (const Crossing& crossing : crossings) {
    left_out_.resize(x.size(), LeftOut::Nothing);
    const LeftOut what = plan.is_spring[crossing.edge] != 0 ? LeftOut::Springs : LeftOut::All;
    for (const Index i : plan.edges[crossing.edge]) left_out_[i] = std::max(left_out_[i], what);
    for (const Index i : plan.pieces[crossing.face].points) left_out_[i] = std::max(left_out_[i], what);
  }
  x_.assign(x.begin(), x.end());
  reach_ = 0.0;
  first_list_ = lists_;
}

bool SurfaceDetection::find_near(const SurfacePlan& plan, std::span<const Vec3> x, std::span<const Vec3> u, double h) {
  tests_ = 0;
  // two features change their distance by no more than their points move relative to each other
  travel_ += 2.0 * max_deviation(x.size(), [&](std::size_t k) { return x[k] - x_[k]; }) + round_off_;
  std::ranges::copy(x, x_.begin());
  h_ = h;
  approach_ = 2.0 * h * max_deviation(u.size(), [&](std::size_t k) { return u[k]; });
  return update(plan);
}

bool SurfaceDetection::change_velocities(const SurfacePlan& plan, std::span<const Vec3> u) {
  const double approach = 2.0 * h_ * max_deviation(u.size(), [&](std::size_t k) { return u[k]; });
  if (approach <= approach_) return true;
  approach_ = approach;
  return update(plan);
}

bool SurfaceDetection::update(const SurfacePlan& plan) {
  const double need = plan.max_thickness * (1.0 + contact::slack) + approach_ / contact::ccd_safety;
  if (need + travel_ > reach_ && !list_pairs(plan, need)) return false;
  near_.clear();
  meeting_.clear();
  for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges}) wake(plan, kind, need);
  return true;
}

bool SurfaceDetection::list_pairs(const SurfacePlan& plan, double need) {
  ++lists_;
  travel_ = 0.0;
  reach_ = need + std::max({relative_margin_ * plan.edge_length, contact::slack * plan.max_thickness, 3.0 * approach_});
  double extent = 0.0;
  for (const Vec3& x : x_) extent = std::max({extent, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
  round_off_ = 1e-14 * extent;
  tree_.refit(x_);
  if (!tree_.find_pairs(plan, x_, reach_, left_out_, max_pairs, pairs_)) {
    reach_ = 0.0;
    return false;
  }
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    keys_[k].clear();
    for (const SurfacePair& pair : pairs_[k]) keys_[k].push_back(pair.distance);
  }
  tests_ += static_cast<long>(keys_[0].size() + keys_[1].size());
  return true;
}

void SurfaceDetection::wake(const SurfacePlan& plan, FeaturePair kind, double need) {
  const std::vector<double>& keys = keys_[static_cast<std::size_t>(kind)];
  const double limit = need + travel_;
  tests_ += static_cast<long>(keys.size() / (8 * block_size));
  std::array<Index, block_size> woken;
  for (std::size_t begin = 0; begin < keys.size(); begin += block_size) {
    std::size_t count = 0;
    for (std::size_t p = begin; p < std::min(begin + block_size, keys.size()); ++p) {
      woken[count] = static_cast<Index>(p);
      count += static_cast<std::size_t>(keys[p] < limit);
    }
    if (count > 0) measure(plan, kind, std::span(woken).first(count), need);
  }
}

void SurfaceDetection::measure(const SurfacePlan& plan, FeaturePair kind, std::span<const Index> woken, double need) {
  const auto k = static_cast<std::size_t>(kind);
  block_.count = 0;
  for (const Index p : woken) block_.points[block_.count++] = pairs_[k][p].points;
  find_closest(kind, x_, block_);
  tests_ += block_.count;
  const double coincident = contact::coincident * plan.max_thickness;
  for (int i = 0; i < block_.count; ++i) {
    const Index p = woken[i];
    const std::array<Index, 4>& points = block_.points[i];
    const double distance = block_.distance[i], radius = plan.radius_of(points);
    keys_[k][p] = distance - radius + travel_;
    if (!(distance - radius < need && distance >= coincident)) continue;
    if (contact::ccd_safety * distance <= approach_) meeting_.push_back({kind, points, distance});
    const auto [first, second] = pairs_[k][p].features;
    const bool touches = kind == FeaturePair::TwoEdges ? block_.is_at_end[i] == 0.0 || (plan.is_spring[first] | plan.is_spring[second]) != 0
                                                       : plan.owns(first, block_.weight[1][i], block_.weight[2][i], block_.weight[3][i]);
    if (!touches) continue;
    // in place: a copy would wait for all of its parts to be written
    NearFeatures& near = near_.emplace_back();
    near.points = points;
    near.closest = block_.closest(i);
    near.contact = radius + plan.thickness_of(points);
    near.pair = p;
    near.kind = kind;
  }
}

}  // namespace hooke
