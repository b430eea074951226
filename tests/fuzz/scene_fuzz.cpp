// The entry point of libFuzzer; scripts/fuzz builds and runs it.

#include <cstddef>
#include <cstdint>

#include "fuzz/part_of_inputs.h"
#include "fuzz/scene_input.h"

// Stepping takes most of the time, and readers need many inputs.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (hooke::is_among(16, bytes))
    hooke::try_as_scene(bytes);
  else
    hooke::read_as_scene(bytes);
  return 0;
}
