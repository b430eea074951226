// The network itself: where its points are seen, and its springs and points as strokes and beads.
#pragma once

#include <vector>

#include "draw/beads.h"
#include "draw/marks.h"
#include "draw/strokes.h"
#include "draw/view.h"

namespace hooke {

// All that one picture is made from.
struct Subject {
  const Snapshot& snapshot;
  const Marks& marks;
  const ViewOptions& options;
  const Projection& projection;
  const Camera& camera;
  const Palette& palette;
};

class Net {
 public:
  // Looks at every point once; the rest uses what was seen.
  void see(const Subject& subject);

  // Springs so close that they cover much of each other: they blend, whichever is in front.
  bool is_dense(const ViewOptions& options) const;

  void add_springs(const Subject& subject, Strokes& strokes) const;
  void add_points(const Subject& subject, Beads& beads) const;
  // Lines under selected and hovered springs, rings around such points.
  void add_marks(const Subject& subject, Strokes& strokes, Beads& beads) const;

  // Of each point. Springs cut corners where points rest on something round: all is drawn this much nearer [m] than it is,
  // so that neither colliders nor faces come through.
  double lift() const { return 0.1 * length_; }
  const std::vector<glm::dvec4>& clip() const { return clip_; }
  const std::vector<Seen>& seen() const { return seen_; }

 private:
  Bead bead_of(const Subject& subject, Index i) const;
  void measure_springs(const Subject& subject);

  std::vector<glm::dvec4> clip_;        // a point
  std::vector<Seen> seen_;              // a point
  std::vector<Index> ends_;             // two a spring
  std::vector<float> strain_;           // a spring
  std::vector<std::uint8_t> selected_;  // a point
  double length_ = 0.0;                 // [m], mean length of a spring; 0 without springs
  double spacing_ = 0.0;                // [px], the same at the camera's target
};

}  // namespace hooke
