// The network itself: where its points are seen, and its springs and points as strokes and beads.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "draw/marks.h"
#include "draw/parts/point_impostors.h"
#include "draw/parts/strokes.h"
#include "draw/view.h"

namespace hooke {

// All that one picture is made from.
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
  // Looks at every point once; the rest uses what was seen.
  void project(const DrawContext& context);

  // Springs so close that they cover much of each other: they blend, whichever is in front.
  bool is_dense(const ViewOptions& options) const;

  // OutsideCloth: what a bare cloth hangs by and what hangs on it: nails, points of no face, and springs to such points.
  enum class Subset { All, OutsideCloth };
  void add_springs(const DrawContext& context, Subset subset, Strokes& strokes) const;
  void add_points(const DrawContext& context, Subset subset, PointImpostors& impostors) const;
  // Lines under selected and hovered springs, rings around such points.
  void add_marks(const DrawContext& context, Strokes& strokes, PointImpostors& impostors) const;

  // Springs cut corners where points rest on something round: all is drawn this much nearer [m] than it is, so that
  // neither colliders nor faces come through.
  double depth_offset() const { return depth_offset_; }
  // Of each spring: its ends, and its strain as it is drawn.
  const std::vector<std::array<Index, 2>>& ends() const { return ends_; }
  // Of each face: its three points, one after the other.
  const std::vector<GLuint>& corners() const { return corners_; }
  // In a scene with faces: a point of none of them, nor of what they wrap.
  bool is_outside_cloth(Index i) const { return !in_cloth_.empty() && !in_cloth_[i]; }
  const std::vector<float>& strain() const { return strain_; }
  // Of each point.
  const std::vector<glm::dvec4>& clip() const { return clip_; }
  const std::vector<ProjectedPoint>& projected() const { return projected_; }

 private:
  void find_ends(const std::shared_ptr<const System>& system);
  void measure_springs(const DrawContext& context);
  std::vector<std::size_t> far_to_near(const DrawContext& context) const;
  PointImpostor impostor_of(const DrawContext& context, Index i) const;

  std::vector<glm::dvec4> clip_;               // a point
  std::vector<ProjectedPoint> projected_;      // a point
  std::vector<std::uint8_t> selected_;         // a point
  std::shared_ptr<const System> ends_system_;  // whose springs' ends are known
  std::vector<std::array<Index, 2>> ends_;     // a spring
  std::vector<GLuint> corners_;                // three a face
  std::vector<std::uint8_t> in_cloth_;         // a point: of a face, or within what faces wrap; empty without faces
  std::vector<float> strain_;                  // a spring
  double spacing_ = 0.0;                       // [px], mean length of a spring at the camera's target; 0 without springs
  double depth_offset_ = 0.0;                  // [m]
};

}  // namespace hooke
