// The entry point of libFuzzer; scripts/fuzz builds and runs it.

#include <cstddef>
#include <cstdint>

#include "fuzz/recording_input.h"
#include "sim/model/hash.h"

// Stepping takes most of the time, and readers need many inputs: one of 16 is stepped. The bytes alone choose it, so that findings can be
// reproduced.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if ((hooke::hash_bytes(bytes) >> 32U) % 16U == 0)
    hooke::try_as_recording(bytes);
  else
    hooke::read_as_recording(bytes);
  return 0;
}
