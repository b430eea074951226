// What is tried on any bytes as a recording, by the fuzzer and by the tests that replay and mutate its corpus.
#pragma once

#include <string_view>

namespace hooke {

// Loads the bytes, or accepts that they are refused. Each edit of a loaded recording must be read back as written, and the scene must be
// valid after every frame of a replay. Aborts if any of this is false.
void try_as_recording(std::string_view bytes);

}  // namespace hooke
