// What is tried on any bytes as a recording, by the fuzzer and by the tests that replay and mutate its corpus.
#pragma once

#include <string_view>

namespace hooke {

// Loads them or sees them refused. Each edit of a recording that is loaded must be written and read again as the same text, and
// playing the recording must leave a scene that is valid after every frame. Aborts when any of it is not so.
void try_as_recording(std::string_view bytes);

}  // namespace hooke
