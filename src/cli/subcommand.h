// A subcommand of hooke-headless. Adding one is one file and one row in command_line.cpp.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "base/bounds.h"
#include "base/errors.h"

namespace hooke {

struct Subcommand {
  const char* name;
  const char* summary;
  // Declares its options; the returned function runs it after parsing and returns the exit code.
  std::function<int()> (*declare)(CLI::App& app);
};

namespace exit_code {
inline constexpr int success = 0;
inline constexpr int check_failed = 1;
inline constexpr int wrong_usage = 2;
inline constexpr int refused = 3;     // InputError
inline constexpr int diverged = 4;    // or the tolerance was not met
inline constexpr int file_error = 5;  // FileError, or another failure of the system
}  // namespace exit_code

// Validates a number: finite and within the bounds.
CLI::Validator within(const Bounds& bounds);
// Validates a name, and replaces it by its number in the list, which converts to an enum.
CLI::Validator one_of(std::vector<std::string> names);

}  // namespace hooke
