// What is tried on any bytes as a recording, by the fuzzer and by the tests that replay and mutate its corpus.
#pragma once

#include <string_view>

namespace hooke {

// Loads the bytes, or accepts that they are refused. Each edit of a loaded recording must be read back as written. Aborts if it is not.
void read_as_recording(std::string_view bytes);

// The same, and plays the recording: the scene must be valid after every frame.
void try_as_recording(std::string_view bytes);

}  // namespace hooke
