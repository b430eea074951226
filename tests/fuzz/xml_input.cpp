#include "fuzz/xml_input.h"

#include "formats/file_kind.h"
#include "fuzz/invariants.h"

namespace hooke {

void try_as_xml(std::string_view bytes) {
  try {
    const LoadedScene loaded = find_file_kind("fuzz.xml")->parse(bytes, "fuzz.xml", {});
    require_valid(loaded);
    require_stable(loaded);
  } catch (const InputError&) {
  }
}

}  // namespace hooke
