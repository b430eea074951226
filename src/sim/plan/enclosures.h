// The closed surfaces of a scene and their volumes, as the pressure force needs them (terms/pressure.cpp). In flat scenes they are closed
// lines, and volumes are areas, per metre of depth.
#pragma once

#include <array>
#include <vector>

#include "sim/model/rest_lengths.h"

namespace hooke {

struct Plan;

// A face, or in flat scenes an edge from points[0] to points[1]; of one orientation in the whole enclosure, which may be inwards.
struct EnclosureSide {
  std::array<Index, 3> points{};
  std::array<Index, 3> edge{};     // of EnclosurePlan::edges, opposite each corner; in flat scenes only edge[0]
  std::array<double, 3> median{};  // [m], bound at rest on the distance of each corner from the middle of the edge opposite
  double size = 0.0;               // [m^2] or [m], at rest
  double weight = 1.0;             // [1], of its volume and area; 1/2: of the halves of a quad by one of its diagonals
};

struct Enclosure {
  Index begin = 0, end = 0;  // of its sides
  // [m^3] or [m^2], of the ball or circle with the same surface at rest: the largest volume without stretch.
  double full_volume = 0.0;
};

struct EnclosurePlan {
  std::vector<Enclosure> enclosures;
  std::vector<EnclosureSide> sides;
  std::vector<EdgeEnds> edges;  // each once
  Index open = 0;               // surfaces that are not closed, in the whole scene

  bool empty() const { return enclosures.empty(); }
};

// Of every set of faces connected by edges. It is closed if every edge belongs to two faces, they have a common orientation, whatever that
// of the faces in the file, and springs give the areas of all faces (rest_faces.h).
// In flat scenes, the border of every such set, of edges that belong to one face, is closed if there is a spring along each; holes are not
// part of the volume. And springs without faces form one where every point of a connected set has exactly two.
EnclosurePlan plan_enclosures(const System& system);

// [m^3] or [m^2]; negative if the orientation is inwards. x and f in the layout of the Plan.
double signed_volume(const Plan& plan, const Enclosure& enclosure, const double* x);
// Adds scale times the derivative of the signed volume.
void add_volume_gradient(const Plan& plan, const Enclosure& enclosure, double scale, const double* x, double* f);

}  // namespace hooke
