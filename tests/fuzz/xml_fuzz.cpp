// The entry point of libFuzzer; scripts/fuzz builds and runs it.

#include <cstddef>
#include <cstdint>

#include "fuzz/xml_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hooke::try_as_xml({reinterpret_cast<const char*>(data), size});
  return 0;
}
