// Projects the points of the network, and draws its springs as strokes and its points as impostors.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "draw/marks.h"
#include "draw/parts/point_impostors.h"
#include "draw/parts/strokes.h"
#include "draw/view.h"

namespace hooke {

// The inputs of one picture.
struct DrawContext {
  const Snapshot& snapshot;
  const Marks& marks;
  const ViewOptions& options;
  const Projection& projection;
  const Camera& camera;
  const Palette& palette;
};

class NetworkRenderer {
 public:
  // Projects every point once, for the functions below. Of a large sheet of which only the surface is drawn, and whose cells are smaller
  // than pixels: the points of every second, third, ... row and column, between which it is drawn.
  void project(const DrawContext& context);

  // Whether springs are so close together that they overlap: then they blend in any order.
  bool is_dense(const ViewOptions& options) const;

  // OutsideCloth: nails, points without a face, and springs to such points: the supports of a cloth and objects attached to it.
  enum class Subset { All, OutsideCloth };
  void add_springs(const DrawContext& context, Subset subset, Strokes& strokes) const;
  void add_points(const DrawContext& context, Subset subset, PointImpostors& impostors) const;
  // Lines below selected and hovered springs, rings around such points.
  void add_marks(const DrawContext& context, Strokes& strokes, PointImpostors& impostors) const;

  // Springs between points on a round collider are chords below its surface. Everything is drawn closer to the viewer by this distance [m],
  // so that neither colliders nor faces show through.
  double depth_offset() const { return depth_offset_; }
  // The end points of each spring.
  const std::vector<std::array<Index, 2>>& ends() const { return ends_; }
  // The three points of each face, or of the larger faces between the points that are projected.
  const std::vector<GLuint>& corners() const { return stride_ > 1 ? coarse_corners_ : corners_; }
  // The points that are projected, in ascending order, and the number of each in this list.
  const std::vector<GLuint>& drawn() const { return drawn_; }
  GLuint number_of(GLuint point) const { return stride_ > 1 ? numbers_[point] : point; }
  // In a scene with faces: whether the point belongs to no face and is not enclosed by faces.
  bool is_outside_cloth(Index i) const { return !in_cloth_.empty() && !in_cloth_[i]; }
  const std::vector<float>& strain() const { return strain_; }
  // Per point.
  const std::vector<glm::dvec4>& clip() const { return clip_; }
  const std::vector<ProjectedPoint>& projected() const { return projected_; }

 private:
  void find_ends(const std::shared_ptr<const System>& system);
  void find_supports(const System& system);
  void choose_stride(const DrawContext& context);
  void measure_springs(const DrawContext& context);
  std::vector<std::size_t> far_to_near(const DrawContext& context, std::vector<std::size_t> springs) const;
  double emphasis(const DrawContext& context) const;
  float spring_stroke(const DrawContext& context) const;  // [px], width
  PointImpostor impostor_of(const DrawContext& context, Index i) const;

  std::vector<glm::dvec4> clip_;               // per point
  std::vector<ProjectedPoint> projected_;      // per point
  std::vector<std::uint8_t> selected_;         // per point
  std::shared_ptr<const System> ends_system_;  // the System of ends_
  std::vector<std::array<Index, 2>> ends_;     // per spring
  std::vector<GLuint> corners_;                // three per face
  std::vector<std::uint8_t> in_cloth_;         // per point: of a face, or enclosed by faces; empty without faces
  std::vector<float> strain_;                  // per spring
  // The nails and points outside the cloth, and springs to such points.
  std::vector<GLuint> supports_;
  std::vector<std::size_t> support_springs_;
  int stride_ = 1, wanted_stride_ = 1;  // every stride_-th row and column of a sheet is drawn
  std::vector<GLuint> drawn_, numbers_, coarse_corners_;
  double spacing_ = 0.0;       // [px], mean length of a spring at the camera's target; 0 without springs
  double depth_offset_ = 0.0;  // [m]
};

}  // namespace hooke
