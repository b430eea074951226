// What is tried on any bytes as a scene file, by the fuzzer and by the test that replays its corpus.
#pragma once

#include <string_view>

namespace hooke {

// Loads them or sees them refused. A scene that is loaded must be saved and loaded again as the same text, and stepping
// a frame of it must not do more harm than to diverge. Aborts when any of it is not so.
void try_as_scene(std::string_view bytes);

}  // namespace hooke
