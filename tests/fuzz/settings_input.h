// What is tried on any bytes as a settings file, by the fuzzer and by the test that replays its corpus.
#pragma once

#include <string_view>

namespace hooke {

// Reads the bytes, or accepts that they are refused. Aborts if a value is outside its range.
void try_as_settings(std::string_view bytes);

}  // namespace hooke
