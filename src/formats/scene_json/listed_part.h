#pragma once

#include "scene/scene.h"

namespace hooke {

// The numbers of points, springs and faces that are listed individually; the rest, at the end, is made by generators.
struct ListedCounts {
  Index points, springs;
  std::size_t faces;
};

// Runs the generators of the scene again. Everything is listed unless the generated items equal the last ones of the scene, bit for bit.
ListedCounts find_listed(const Scene& scene);

}  // namespace hooke
