// What is tried on any bytes as a settings file, by the fuzzer and by the test that replays its corpus.
#pragma once

#include <string_view>

namespace hooke {

// Reads them or sees them refused. What is read lies within its ranges. Aborts when it is not so.
void try_as_settings(std::string_view bytes);

}  // namespace hooke
