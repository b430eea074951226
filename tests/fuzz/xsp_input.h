// What is tried on any bytes as an .xsp file, by the fuzzer and by the test that replays its corpus.
#pragma once

#include <string_view>

namespace hooke {

// Loads the bytes, or accepts that they are refused. A loaded scene must be valid, have a stable step, and be read back unchanged after
// writing. Aborts if any of this is false.
void try_as_xsp(std::string_view bytes);

}  // namespace hooke
