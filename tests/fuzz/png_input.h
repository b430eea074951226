// What is tried on any bytes as a PNG for a texture, by the fuzzer and by the tests that replay and mutate its corpus.
#pragma once

#include <string>
#include <string_view>

namespace hooke {

// Decodes them or sees them refused: as they are, and with the checksums of the chunks made right, without which nearly all
// that is changed would be refused at once. Aborts when a picture is not as large as it says, or larger than it may be.
void try_as_png(std::string_view bytes);

// The same file with right checksums, as far as it consists of chunks.
std::string with_checksums(std::string bytes);

}  // namespace hooke
