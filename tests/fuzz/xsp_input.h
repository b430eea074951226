// What is tried on any bytes as an .xsp file, by the fuzzer and by the test that replays its corpus.
#pragma once

#include <string_view>

namespace hooke {

// Loads them or sees them refused. A scene that is loaded must be sound, have a step that holds, and come back from what is
// written of it. Aborts when any of it is not so.
void try_as_xsp(std::string_view bytes);

}  // namespace hooke
