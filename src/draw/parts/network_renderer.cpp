#include "draw/parts/network_renderer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>

#include "draw/parts/spring_shapes.h"

namespace hooke {
namespace {

constexpr double spring_width = 1.75;  // [px of the screen]
constexpr double min_radius = 2.5;     // [px of the screen], of a point in an open network
constexpr double mark_radius = 4.0;    // [px of the screen], minimum for a marked or nailed point
constexpr double dense = 12.0;         // [px of the screen]: springs shorter than this are drawn thinner
constexpr double mark_width = 5.0;     // [px of the screen], of a marked spring
constexpr double ring_distance = 3.0;  // [px of the screen], of the ring around a selected point
// Smaller scenes are drawn with all of their points.
constexpr std::size_t min_points_of_coarse = 100'000;
constexpr std::size_t sampled_spring = 61;  // one of so many
constexpr double min_cell = 2.0;            // [px], of a sheet that is drawn with some of them

// Table of colors for strains from -1 to 1 of the scale.
constexpr int strain_steps = 256;
using StrainColors = std::array<Rgba, strain_steps + 1>;

const StrainColors& fill_strain_colors() {
  static const StrainColors colors = [] {
    StrainColors made;
    for (int i = 0; i <= strain_steps; ++i) made[i] = rgba(View::strain_color(2.0 * i / strain_steps - 1.0));
    return made;
  }();
  return colors;
}

// Sheets of rows x columns points, row by row, whose cells are two faces each (scene/shapes/cloth.cpp).
struct FaceGrid {
  GLuint first, rows, columns;

  template <class Use>
  void for_each_cell(GLuint stride, const Use& use) const {
    for (GLuint r = 0; r + 1 < rows; r += stride)
      for (GLuint c = 0; c + 1 < columns; c += stride) {
        const GLuint a = first + r * columns + c, right = std::min(stride, columns - 1 - c),
                     down = std::min(stride, rows - 1 - r) * columns;
        for (const GLuint corner : {a, a + down, a + right, a + right, a + down, a + right + down}) use(corner);
      }
  }
};

// The sheets that these faces are; none if there are any others.
std::vector<FaceGrid> face_grids(const std::vector<GLuint>& corners) {
  std::vector<FaceGrid> grids;
  for (std::size_t at = 0; at < corners.size();) {
    FaceGrid grid{corners[at], 2, corners[at + 1] - corners[at]};
    const auto row_fits = [&] {
      std::size_t next = at;
      bool fits = grid.columns >= 2;
      const FaceGrid row{grid.first + (grid.rows - 2) * grid.columns, 2, grid.columns};
      if (fits && at + 6 * std::size_t{grid.columns - 1} > corners.size()) return false;
      if (fits) row.for_each_cell(1, [&](GLuint corner) { fits = fits && corners[next++] == corner; });
      return fits;
    };
    for (; row_fits(); ++grid.rows) at += 6 * std::size_t{grid.columns - 1};
    if (--grid.rows < 2) return {};
    grids.push_back(grid);
  }
  return grids;
}

}  // namespace

void NetworkRenderer::project(const DrawContext& context) {
  measure_springs(context);
  choose_stride(context);
  const State& state = context.snapshot.state;
  clip_.resize(state.position.size());
  projected_.resize(state.position.size());
  const auto project = [&](Index i) {
    clip_[i] = context.projection.moved_nearer(context.projection.clip(state.position[i]), depth_offset());
    projected_[i] = context.projection.project(clip_[i]);
  };
  for (const GLuint i : drawn_) project(static_cast<Index>(i));

  selected_.assign(state.position.size(), 0);
  for (const PointId id : context.marks.selected_points) {
    const Index i = context.snapshot.system->index_of(id);
    if (i == no_index) continue;
    selected_[i] = 1;
    project(i);
  }
  for (const auto& id : {context.marks.hovered_point, context.marks.failed_point})
    if (const Index i = id ? context.snapshot.system->index_of(*id) : no_index; i != no_index) project(i);
}

// A shared System never changes, so the same pointer means the same springs.
void NetworkRenderer::find_ends(const std::shared_ptr<const System>& system) {
  if (system == ends_system_) return;
  ends_system_ = system;
  ends_.clear();
  for (const Spring& spring : system->springs()) ends_.push_back({system->index_of(spring.first), system->index_of(spring.second)});

  stride_ = wanted_stride_ = 1;
  drawn_.resize(system->points().size());
  std::iota(drawn_.begin(), drawn_.end(), 0);
  corners_.clear();
  corners_.reserve(3 * system->faces.size());
  in_cloth_.assign(system->faces.empty() ? 0 : system->points().size(), 0);
  if (in_cloth_.empty()) return find_supports(*system);
  for (const Face& face : system->faces)
    for (const PointId id : face.points) {
      corners_.push_back(static_cast<GLuint>(system->index_of(id)));
      in_cloth_[corners_.back()] = 1;
    }
  // Points inside a solid are found by the families of their springs.
  for (std::size_t s = 0; s < ends_.size(); ++s)
    if (system->springs()[s].family != SpringFamily::None) in_cloth_[ends_[s][0]] = in_cloth_[ends_[s][1]] = 1;
  find_supports(*system);
}

void NetworkRenderer::find_supports(const System& system) {
  supports_.clear();
  support_springs_.clear();
  for (Index i = 0; i < system.point_count(); ++i)
    if (system.points()[i].nailed || is_outside_cloth(i)) supports_.push_back(static_cast<GLuint>(i));
  for (std::size_t s = 0; s < ends_.size(); ++s)
    if (is_outside_cloth(ends_[s][0]) || is_outside_cloth(ends_[s][1])) support_springs_.push_back(s);
}

// Marked springs may be drawn at any point.
void NetworkRenderer::choose_stride(const DrawContext& context) {
  const Marks& marks = context.marks;
  const bool has_marks = !marks.selected_springs.empty() || marks.hovered_spring || marks.failed_spring || marks.crossed;
  const bool is_surface = context.options.surface && !context.options.springs && !context.options.points;
  const bool may = in_cloth_.size() >= min_points_of_coarse && is_surface && !has_marks && spacing_ > 0.0;
  const int stride = may ? static_cast<int>(std::clamp(std::ceil(min_cell / spacing_), 1.0, 64.0)) : 1;
  if (std::exchange(wanted_stride_, stride) == stride) return;
  const std::vector<FaceGrid> grids = stride > 1 ? face_grids(corners_) : std::vector<FaceGrid>();
  stride_ = grids.empty() ? 1 : stride;

  coarse_corners_.clear();
  numbers_.assign(in_cloth_.size(), grids.empty() ? 1 : 0);
  for (const FaceGrid& grid : grids)
    grid.for_each_cell(static_cast<GLuint>(stride), [&](GLuint corner) { coarse_corners_.push_back(corner); });
  for (const GLuint corner : coarse_corners_) numbers_[corner] = 1;
  for (const GLuint i : supports_) numbers_[i] = 1;
  for (const std::size_t s : support_springs_) numbers_[ends_[s][0]] = numbers_[ends_[s][1]] = 1;
  drawn_.clear();
  for (GLuint i = 0; i < numbers_.size(); ++i)
    if (std::exchange(numbers_[i], static_cast<GLuint>(drawn_.size())) != 0) drawn_.push_back(i);
}

void NetworkRenderer::measure_springs(const DrawContext& context) {
  find_ends(context.snapshot.system);
  const SpringList& springs = context.snapshot.system->springs();
  const std::vector<Vec3>& position = context.snapshot.state.position;
  strain_.resize(springs.size());
  double sum = 0.0;
  int counted = 0;
  // the spacing of a large sheet is estimated from a sample of its springs
  const bool needs_all = context.options.strain_colors || context.options.springs || position.size() < min_points_of_coarse;
  for (std::size_t s = 0; s < springs.size(); s += needs_all ? 1 : sampled_spring) {
    const double length = glm::distance(position[ends_[s][0]], position[ends_[s][1]]),
                 rest = springs.have_laws() ? context.snapshot.system->rest_length_of(springs[s], context.snapshot.state.time)
                                            : springs[s].rest_length;
    strain_[s] = static_cast<float>(rest > 0.0 ? length / rest - 1.0 : length);
    if (!std::isfinite(length)) continue;
    sum += length;
    ++counted;
  }
  const double length = counted > 0 ? sum / counted : 0.0;
  const double pixel = context.camera.meters_per_pixel(context.camera.target, {context.projection.width(), context.projection.height()});
  constexpr double max_lift = 4.0;  // [px]
  spacing_ = length / pixel;
  depth_offset_ = std::min(0.1 * length, max_lift * pixel);
}

bool NetworkRenderer::is_dense(const ViewOptions& options) const { return spacing_ > 0.0 && spacing_ < options.scale * dense; }

// The order in which springs are drawn. In an open 3-D network, distant springs come first, so that the antialiased edges of near ones
// blend with the background.
std::vector<std::size_t> NetworkRenderer::far_to_near(const DrawContext& context, std::vector<std::size_t> order) const {
  if (context.snapshot.system->dimensions == 2 || is_dense(context.options)) return order;
  const auto depth = [&](std::size_t s) {
    const float sum = projected_[ends_[s][0]].depth + projected_[ends_[s][1]].depth;
    return std::isfinite(sum) ? sum : 0.0f;
  };
  std::ranges::stable_sort(order, std::greater<>(), depth);
  return order;
}

void NetworkRenderer::add_springs(const DrawContext& context, Subset subset, Strokes& strokes) const {
  const float width = spring_stroke(context);
  const StrainColors& colors = fill_strain_colors();
  const auto steps = static_cast<float>(0.5 * strain_steps / View::strain_scale(context.snapshot));
  const Rgba plain = rgba(context.palette.spring);

  const System& system = *context.snapshot.system;
  const bool all_on = std::ranges::find(system.switches.families, false) == system.switches.families.end();
  const bool has_curves = system.springs().have_laws() || context.options.coils;
  if (subset == Subset::All) strokes.reserve(strain_.size());
  std::vector<std::size_t> drawn = support_springs_;
  if (subset == Subset::All) {
    drawn.resize(ends_.size());
    std::iota(drawn.begin(), drawn.end(), std::size_t(0));
  }
  for (const std::size_t s : far_to_near(context, std::move(drawn))) {
    if (!all_on && !system.is_on(system.springs()[s])) continue;
    const auto [a, b] = ends_[s];
    Rgba color = plain;
    if (context.options.strain_colors) {
      const float step = 0.5f * strain_steps + strain_[s] * steps;
      color = colors[step >= 0.0f ? static_cast<int>(std::min(step, float(strain_steps))) : 0];
    }
    float own_width = width;
    if (has_curves) {
      const std::vector<Vec3>& position = context.snapshot.state.position;
      if (add_spring_curve(context, system.springs()[s], position[a], position[b], color, own_width, depth_offset(), strokes)) continue;
    }
    strokes.add(context.projection, clip_[a], projected_[a], clip_[b], projected_[b], color, own_width);
  }
}

// 1 for marks as large as they are drawn in an open network; less where many marks are so close together that they would cover it.
double NetworkRenderer::emphasis(const DrawContext& context) const {
  constexpr std::size_t few = 50;
  constexpr double covered = 6.0, open = 24.0;  // [px of the screen], spacing
  if (spacing_ == 0.0 || std::max(context.marks.selected_points.size(), context.marks.selected_springs.size()) <= few) return 1.0;
  return std::clamp((spacing_ / context.options.scale - covered) / (open - covered), 0.0, 1.0);
}

float NetworkRenderer::spring_stroke(const DrawContext& context) const {
  const double scale = context.options.scale;
  return static_cast<float>(scale * spring_width * std::clamp(spacing_ / (scale * dense), 0.35, 1.0));
}

PointImpostor NetworkRenderer::impostor_of(const DrawContext& context, Index i) const {
  const Point& point = context.snapshot.system->points()[i];
  const double scale = context.options.scale;

  // In a dense net points shrink with the spacing, so that springs stay visible.
  const double sparse = spacing_ > 0.0 ? spacing_ / scale : 1e3;
  const double wider = sparse / (3.0 * dense);
  const double max = scale * 0.16 * sparse * (1.0 + wider * wider);
  const double min = scale * std::min(min_radius, 0.22 * sparse);
  double radius = std::max(point.radius * projected_[i].scale, min);
  if (!is_outside_cloth(i)) radius = std::min(radius, max);
  const double marked = mark_radius * scale * std::clamp(sparse / dense, 0.6, 1.0);
  const bool is_support = point.nailed || point.fixed_axes != 0;
  if (is_support) radius = std::max(radius, marked);
  if (selected_[i]) radius = std::max(radius, radius + emphasis(context) * (marked - radius));

  PointImpostor impostor{.radius = static_cast<float>(radius), .square = point.nailed};
  const bool is_plain = !point.color && !is_support;
  const Color color = is_support ? context.palette.nailed : point.color.value_or(context.palette.point);
  impostor.body = rgba(selected_[i] && is_plain ? context.palette.selected : color);
  if (is_plain && !selected_[i]) impostor.body.opacity = static_cast<std::uint8_t>(255.0 * std::clamp((sparse - 5.0) / 8.0, 0.0, 1.0));
  return impostor;
}

void NetworkRenderer::add_points(const DrawContext& context, Subset subset, PointImpostors& impostors) const {
  if (subset == Subset::All) impostors.reserve(projected_.size());
  constexpr std::uint8_t min_opacity = 16;
  for (const GLuint i : subset == Subset::All ? drawn_ : supports_) {
    if (projected_[i].outside & (Before | Beyond | NotFinite)) continue;
    const PointImpostor impostor = impostor_of(context, i);
    if (impostor.body.opacity >= min_opacity) impostors.add(context.projection, clip_[i], projected_[i], impostor);
  }
}

void NetworkRenderer::add_marks(const DrawContext& context, Strokes& strokes, PointImpostors& impostors) const {
  const System& system = *context.snapshot.system;
  const double scale = context.options.scale, emphasis_now = emphasis(context);
  const auto full_width = static_cast<float>(mark_width * scale);
  const auto add_spring = [&](SpringId id, Rgba color, float width) {
    const Index s = system.index_of(id);
    if (s == no_index) return;
    const auto [a, b] = ends_[s];
    strokes.add(context.projection, clip_[a], projected_[a], clip_[b], projected_[b], color, width);
  };
  const float thin = spring_stroke(context), width = thin + static_cast<float>(emphasis_now) * (full_width - thin);
  for (const SpringId id : context.marks.selected_springs) add_spring(id, rgba(context.palette.selected, 0.7), width);
  if (context.marks.failed_spring) add_spring(*context.marks.failed_spring, rgba(context.palette.failed, 0.85), 1.6f * full_width);
  if (context.marks.hovered_spring) add_spring(*context.marks.hovered_spring, rgba(context.palette.hover, 0.35), full_width);

  // edges that pass through faces, and the outlines of the faces; springs that cross
  const auto add_line = [&](PointId first, PointId second, Rgba color, float line_width) {
    const Index a = system.index_of(first), b = system.index_of(second);
    if (a == no_index || b == no_index) return;
    strokes.add(context.projection, clip_[a], projected_[a], clip_[b], projected_[b], color, line_width);
  };
  if (context.marks.crossed) {
    for (const auto& corners : context.marks.crossed->faces)
      for (std::size_t c = 0; c < 3; ++c) add_line(corners[c], corners[(c + 1) % 3], rgba(context.palette.crossed, 0.7), 0.4f * full_width);
    for (const auto* lines : {&context.marks.crossed->edges, &context.marks.crossed->springs, &context.marks.crossed->across})
      for (const auto& [first, second] : *lines) add_line(first, second, rgba(context.palette.crossed, 0.95), 0.8f * full_width);
  }

  // Only rings: the points themselves are already drawn.
  const auto add_ring = [&](Index i, double distance, Rgba color) {
    PointImpostor ring = impostor_of(context, i);
    ring.body.opacity = 0;
    ring.ring = ring.radius + static_cast<float>(distance * scale);
    ring.ring_color = color;
    impostors.add(context.projection, clip_[i], projected_[i], ring);
  };
  if (context.marks.crossed) {
    std::vector<PointId> overlapping = context.marks.crossed->spheres;
    for (const auto& [first, second] : context.marks.crossed->points) overlapping.insert(overlapping.end(), {first, second});
    std::ranges::sort(overlapping);
    overlapping.erase(std::unique(overlapping.begin(), overlapping.end()), overlapping.end());
    for (const PointId id : overlapping)
      if (const Index i = system.index_of(id); i != no_index) add_ring(i, 3.0, rgba(context.palette.crossed));
  }
  for (const PointId id : context.marks.selected_points)
    if (const Index i = system.index_of(id); i != no_index) {
      // plain points are red themselves
      const bool is_plain = !system.points()[i].color && !system.points()[i].nailed;
      const double distance = is_plain ? ring_distance * emphasis_now : std::max(1.0, ring_distance * emphasis_now);
      if (distance >= 1.0) add_ring(i, distance, rgba(context.palette.selected));
    }
  if (context.marks.failed_point)
    if (const Index i = system.index_of(*context.marks.failed_point); i != no_index)
      for (const double distance : {5.0, 10.0}) add_ring(i, distance, rgba(context.palette.failed));
  if (!context.marks.hovered_point) return;
  if (const Index i = system.index_of(*context.marks.hovered_point); i != no_index)
    add_ring(i, selected_[i] ? 6.0 : 4.0, rgba(context.palette.hover, 0.8));
}

}  // namespace hooke
