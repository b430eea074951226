// Random scenes that use every field of the scene format, for tests of what must hold for any document.
#pragma once

#include "base/bounds.h"
#include "scene/scene.h"
#include "support/random_scene.h"

namespace hooke {

enum class Numbers {
  Any,       // all that the format allows, the smallest and the largest included
  Ordinary,  // of a size that can be simulated
};

// A scene whose points and springs are numbered from 0, as they are after loading.
Scene random_document(Random& random, Numbers numbers);

// A list of generators as it stands in a file, for scenes of any dimensions.
std::string random_generators(Random& random);

// A value within the bounds.
double random_number(Random& random, Numbers numbers, const Bounds& bounds = any_number);

// UTF-8 of up to `max_length` characters: controls, quotes, letters of one to four bytes.
std::string random_text(Random& random, Index max_length);

}  // namespace hooke
