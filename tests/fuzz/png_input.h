// What is tried on any bytes as a PNG for a texture, by the fuzzer and by the tests that replay and mutate its corpus.
#pragma once

#include <string>
#include <string_view>

namespace hooke {

// Decodes the bytes, or accepts that they are refused: as given, and with corrected chunk checksums, without which almost all mutations
// would be refused at once. Aborts if a picture does not have the size in its header or exceeds the limits.
void try_as_png(std::string_view bytes);

// The same file with correct checksums, as far as it consists of chunks.
std::string with_checksums(std::string bytes);

}  // namespace hooke
