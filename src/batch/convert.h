// Converts a file from one format to another: `hooke convert`, and `convert` of the Python module.
#pragma once

#include <string>
#include <vector>

namespace hooke {

// `in` is a file or the id of a shipped scene; the extension of `out` determines the format. Returns warnings about the file, and what the
// format cannot represent. Throws UsageError, InputError, FileError.
std::vector<std::string> convert_file(const std::string& in, const std::string& out);

}  // namespace hooke
