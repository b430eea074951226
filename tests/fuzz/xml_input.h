// What is tried on any bytes as an .xml file of Sodaconstructor, by the fuzzer and by the test that replays its corpus.
#pragma once

#include <string_view>

namespace hooke {

// Loads the bytes, or accepts that they are refused. A loaded scene must be valid and have a stable step. Aborts if any of this is false.
void try_as_xml(std::string_view bytes);

}  // namespace hooke
