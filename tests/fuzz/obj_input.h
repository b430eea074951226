// What is tried on any bytes as an .obj file, by the fuzzer and by the test that replays its corpus.
#pragma once

#include <string_view>

namespace hooke {

// Loads the bytes, or accepts that they are refused. A loaded mesh must be valid cloth with a stable step and must be writable as a mesh.
// Aborts if any of this is false.
void try_as_obj(std::string_view bytes);

}  // namespace hooke
