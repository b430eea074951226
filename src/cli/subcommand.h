// What a subcommand of hooke-headless is. Adding one is one file and one row in main.cpp.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>

#include "base/bounds.h"

namespace hooke {

struct Subcommand {
  const char* name;
  const char* summary;
  // Declares its options; what it returns does the work once they are parsed, and gives the exit code.
  std::function<int()> (*declare)(CLI::App& app);
};

namespace exit_code {
inline constexpr int success = 0;
inline constexpr int check_failed = 1;
inline constexpr int wrong_usage = 2;
inline constexpr int refused = 3;     // Refused: the input
inline constexpr int diverged = 4;    // or the tolerance was not met
inline constexpr int file_error = 5;  // FileError, or the system would not do something else
}  // namespace exit_code

// A command line that cannot be followed, found after it was parsed: what() is one line.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// For options that are numbers: finite and within the bounds.
CLI::Validator within(const Bounds& bounds);

}  // namespace hooke
