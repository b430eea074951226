// What is tried on any bytes as an .obj file, by the fuzzer and by the test that replays its corpus.
#pragma once

#include <string_view>

namespace hooke {

// Loads them or sees them refused. A mesh that is loaded must be sound cloth with a step that holds, and can be written as
// any mesh. Aborts when any of it is not so.
void try_as_obj(std::string_view bytes);

}  // namespace hooke
