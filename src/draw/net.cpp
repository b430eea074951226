#include "draw/net.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>

namespace hooke {
namespace {

constexpr double spring_width = 1.75;  // [px of the screen]
constexpr double least_radius = 2.5;   // [px of the screen], of a point in an open network
constexpr double mark_radius = 4.0;    // [px of the screen], of a marked or nailed point
constexpr double dense = 12.0;         // [px of the screen]: springs shorter than this are drawn thinner

// Colours of a strain from -1 to 1 of the scale, looked up.
constexpr int strain_steps = 256;
using StrainInks = std::array<Ink, strain_steps + 1>;

const StrainInks& strain_inks() {
  static const StrainInks inks = [] {
    StrainInks made;
    for (int i = 0; i <= strain_steps; ++i) made[i] = ink(View::strain_color(2.0 * i / strain_steps - 1.0));
    return made;
  }();
  return inks;
}

}  // namespace

void Net::see(const Subject& subject) {
  measure_springs(subject);
  const State& state = subject.snapshot.state;
  clip_.resize(state.position.size());
  seen_.resize(state.position.size());
  for (std::size_t i = 0; i < state.position.size(); ++i) {
    clip_[i] = subject.projection.moved_nearer(subject.projection.clip(state.position[i]), lift());
    seen_[i] = subject.projection.see(clip_[i]);
  }

  selected_.assign(state.position.size(), 0);
  for (const PointId id : subject.marks.selected_points) {
    const Index i = subject.snapshot.system->index_of(id);
    if (i != no_index) selected_[i] = 1;
  }
}

// A System does not change while somebody holds it.
void Net::find_ends(const std::shared_ptr<const System>& system) {
  if (system == ends_system_) return;
  ends_system_ = system;
  ends_.clear();
  for (const Spring& spring : system->springs()) ends_.push_back({system->index_of(spring.first), system->index_of(spring.second)});

  corners_.clear();
  corners_.reserve(3 * system->faces.size());
  in_cloth_.assign(system->faces.empty() ? 0 : system->points().size(), 0);
  if (in_cloth_.empty()) return;
  for (const Face& face : system->faces)
    for (const PointId id : face.points) {
      corners_.push_back(static_cast<GLuint>(system->index_of(id)));
      in_cloth_[corners_.back()] = 1;
    }
  // what is inside a solid belongs to it, by springs of its families
  for (std::size_t s = 0; s < ends_.size(); ++s)
    if (system->springs()[s].family != SpringFamily::None) in_cloth_[ends_[s][0]] = in_cloth_[ends_[s][1]] = 1;
}

void Net::measure_springs(const Subject& subject) {
  find_ends(subject.snapshot.system);
  const std::vector<Spring>& springs = subject.snapshot.system->springs();
  const std::vector<Vec3>& position = subject.snapshot.state.position;
  strain_.resize(springs.size());
  double sum = 0.0;
  int counted = 0;
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const double length = glm::distance(position[ends_[s][0]], position[ends_[s][1]]), rest = springs[s].rest_length;
    strain_[s] = static_cast<float>(rest > 0.0 ? length / rest - 1.0 : length);
    if (!std::isfinite(length)) continue;
    sum += length;
    ++counted;
  }
  const double length = counted > 0 ? sum / counted : 0.0;
  const double pixel = subject.camera.metres_per_pixel(subject.camera.target, {subject.projection.width(), subject.projection.height()});
  constexpr double most_lift = 4.0;  // [px]
  spacing_ = length / pixel;
  lift_ = std::min(0.1 * length, most_lift * pixel);
}

bool Net::is_dense(const ViewOptions& options) const { return spacing_ > 0.0 && spacing_ < options.scale * dense; }

// The order in which to draw springs. In an open net in space the far ones come first, so that the soft edge of a near one
// lies on what is behind it and does not cut it out.
std::vector<std::size_t> Net::far_to_near(const Subject& subject) const {
  std::vector<std::size_t> order(ends_.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  if (subject.snapshot.system->dimensions == 2 || is_dense(subject.options)) return order;
  const auto depth = [&](std::size_t s) {
    const float sum = seen_[ends_[s][0]].depth + seen_[ends_[s][1]].depth;
    return std::isfinite(sum) ? sum : 0.0f;
  };
  std::ranges::stable_sort(order, std::greater<>(), depth);
  return order;
}

void Net::add_springs(const Subject& subject, Which which, Strokes& strokes) const {
  const double scale = subject.options.scale;
  const auto width = static_cast<float>(scale * spring_width * std::clamp(spacing_ / (scale * dense), 0.35, 1.0));
  const StrainInks& inks = strain_inks();
  const auto steps = static_cast<float>(0.5 * strain_steps / View::strain_scale(subject.snapshot));
  const Ink plain = ink(subject.palette.spring);

  const System& system = *subject.snapshot.system;
  const bool all_on = std::ranges::find(system.family_on, false) == system.family_on.end();
  if (which == Which::All) strokes.reserve(strain_.size());
  for (const std::size_t s : far_to_near(subject)) {
    if (!all_on && !system.is_on(system.springs()[s])) continue;
    const auto [a, b] = ends_[s];
    if (which == Which::BesideCloth && !is_beside_cloth(a) && !is_beside_cloth(b)) continue;
    Ink color = plain;
    if (subject.options.strain_colors) {
      const float step = 0.5f * strain_steps + strain_[s] * steps;
      color = inks[step >= 0.0f ? static_cast<int>(std::min(step, float(strain_steps))) : 0];
    }
    strokes.add(subject.projection, clip_[a], seen_[a], clip_[b], seen_[b], color, width);
  }
}

Bead Net::bead_of(const Subject& subject, Index i) const {
  const Point& point = subject.snapshot.system->points()[i];
  const double scale = subject.options.scale;

  // in a dense net points shrink with the spacing, so that the springs stay in sight
  const double sparse = spacing_ > 0.0 ? spacing_ / scale : 1e3;
  const double wider = sparse / (3.0 * dense);
  const double most = scale * 0.16 * sparse * (1.0 + wider * wider);
  const double least = scale * std::min(least_radius, 0.22 * sparse);
  double radius = std::max(point.radius * seen_[i].scale, least);
  if (!is_beside_cloth(i)) radius = std::min(radius, most);
  if (point.nailed || selected_[i]) radius = std::max(radius, mark_radius * scale * std::clamp(sparse / dense, 0.6, 1.0));

  Bead bead{.radius = static_cast<float>(radius), .square = point.nailed};
  const bool is_plain = !point.color && !point.nailed;
  const Color color = point.color ? *point.color : point.nailed ? subject.palette.nailed : subject.palette.point;
  bead.body = ink(selected_[i] && is_plain ? subject.palette.selected : color);
  if (is_plain && !selected_[i]) bead.body.opacity = static_cast<std::uint8_t>(255.0 * std::clamp((sparse - 5.0) / 8.0, 0.0, 1.0));
  return bead;
}

void Net::add_points(const Subject& subject, Which which, Beads& beads) const {
  if (which == Which::All) beads.reserve(seen_.size());
  constexpr std::uint8_t least_opacity = 16;
  for (Index i = 0; i < static_cast<Index>(seen_.size()); ++i) {
    if (seen_[i].outside & (before | beyond | not_a_place)) continue;
    if (which == Which::BesideCloth && !subject.snapshot.system->points()[i].nailed && !is_beside_cloth(i)) continue;
    const Bead bead = bead_of(subject, i);
    if (bead.body.opacity >= least_opacity) beads.add(subject.projection, clip_[i], seen_[i], bead);
  }
}

void Net::add_marks(const Subject& subject, Strokes& strokes, Beads& beads) const {
  const System& system = *subject.snapshot.system;
  const double scale = subject.options.scale;
  const auto add_spring = [&](SpringId id, Ink color) {
    const Index s = system.index_of(id);
    if (s == no_index) return;
    const auto [a, b] = ends_[s];
    strokes.add(subject.projection, clip_[a], seen_[a], clip_[b], seen_[b], color, static_cast<float>(5.0 * scale));
  };
  for (const SpringId id : subject.marks.selected_springs) add_spring(id, ink(subject.palette.selected, 0.7));
  if (subject.marks.hovered_spring) add_spring(*subject.marks.hovered_spring, ink(subject.palette.hover, 0.35));

  // rings alone: the points themselves are drawn already
  const auto add_ring = [&](Index i, double distance, Ink color) {
    Bead ring = bead_of(subject, i);
    ring.body.opacity = 0;
    ring.ring = ring.radius + static_cast<float>(distance * scale);
    ring.ring_ink = color;
    beads.add(subject.projection, clip_[i], seen_[i], ring);
  };
  for (const PointId id : subject.marks.selected_points)
    if (const Index i = system.index_of(id); i != no_index) add_ring(i, 3.0, ink(subject.palette.selected));
  if (!subject.marks.hovered_point) return;
  if (const Index i = system.index_of(*subject.marks.hovered_point); i != no_index)
    add_ring(i, selected_[i] ? 6.0 : 4.0, ink(subject.palette.hover, 0.8));
}

}  // namespace hooke
