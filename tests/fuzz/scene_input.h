// What is tried on any bytes as a scene file, by the fuzzer and by the test that replays its corpus.
#pragma once

#include <string_view>

namespace hooke {

// Loads the bytes, or accepts that they are refused. A loaded scene must be saved and read back as the same text. Aborts if it is not.
void read_as_scene(std::string_view bytes);

// The same, and steps a frame of the scene, which may diverge but must do no other harm.
void try_as_scene(std::string_view bytes);

}  // namespace hooke
