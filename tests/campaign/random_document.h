// Random scenes that use every field of the scene format, for tests of properties of any document.
#pragma once

#include "base/bounds.h"
#include "scene/scene.h"
#include "support/random_scene.h"

namespace hooke {

enum class Numbers {
  Any,       // everything that the format allows, including the smallest and largest numbers
  Ordinary,  // numbers of a size that can be simulated
};

// A scene whose points and springs have ids from 0, as they have after loading.
Scene random_document(Random& random, Numbers numbers);

// A list of generators in the syntax of a file, for scenes of any dimensions.
std::string random_generators(Random& random);

// A value within the bounds.
double random_number(Random& random, Numbers numbers, const Bounds& bounds = any_number);

// UTF-8 of up to `max_length` characters: control characters, quotes, characters of one to four bytes.
std::string random_text(Random& random, Index max_length);

}  // namespace hooke
