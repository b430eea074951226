// Errors in the input of a user. Errors in the program are assertions.
#pragma once

#include <stdexcept>

namespace hooke {

// Invalid input (exit code 3): what() is one line, "FILE: FIELD: VALUE: LIMIT".
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A file that could not be read or written (exit code 5): what() is one line with the file and the system's reason.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A wrong option or argument (exit code 2): what() is one line that names it.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace hooke
