// Points, springs and faces as plain lists, before they become part of a scene.
#pragma once

#include <cstdint>
#include <vector>

#include "base/lists/number_list.h"
#include "scene/view_settings.h"
#include "sim/model/system.h"

namespace hooke {

// The id of each point and spring is its index. The elements listed in a file and those made by shapes are collected here.
struct Network {
  std::vector<Point> points;
  std::vector<Vec3> position, velocity;
  ClothCoordinates cloth_coordinates;  // of the points on their cloths; points beyond its end have none
  SpringList springs;
  FaceList faces;
  NumberList rest_angles;                 // of the corners of all faces (Face::rest_angle); empty: as drawn
  NumberList sheet_areas, sheet_weights;  // of points [m^2] and springs [1] in their sheets (SheetWeights)
};

struct ElementCount {
  std::uint64_t points = 0, springs = 0, faces = 0;
};

}  // namespace hooke
