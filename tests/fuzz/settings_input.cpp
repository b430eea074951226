#include "fuzz/settings_input.h"

#include "app/document/preferences.h"
#include "base/errors.h"
#include "fuzz/invariants.h"

namespace hooke {

void try_as_settings(std::string_view bytes) {
  try {
    const Preferences read = parse_preferences(std::string(bytes), "fuzzed.json");
    for (const PreferenceRow& row : preference_rows())
      require(read.*row.field >= row.min && read.*row.field <= row.max, "numbers are within their ranges");
  } catch (const InputError& refused) {
    // one line, without control characters that a terminal would interpret
    for (const char* c = refused.what(); *c != '\0'; ++c)
      require(static_cast<unsigned char>(*c) >= 0x20 && *c != 0x7f, "messages have no control characters");
  }
}

}  // namespace hooke
