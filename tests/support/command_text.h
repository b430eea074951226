// The text of a command, as in recordings.
#pragma once

#include <string>

#include "base/json_writer.h"
#include "edit/command_text.h"

namespace hooke {

inline std::string text_of(const Command& command) {
  JsonWriter out;
  write_command(out, command);
  return out.take();
}

}  // namespace hooke
