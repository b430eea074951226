// Serialization of commands to JSON and back, bit for bit.
#pragma once

#include "base/json_field.h"
#include "base/json_writer.h"
#include "edit/command.h"

namespace hooke {

// An object with one member, named like the command. A Replace cannot be written: a whole scene has its own text.
void write_command(JsonWriter& out, const Command& command);

// Whether a member is named like a command.
bool is_command(const JsonField& member);

// The command of such a member. Throws InputError for anything else.
Command read_command(const JsonField& member);

}  // namespace hooke
