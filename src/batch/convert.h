// Converts a file from one format to another: `hooke convert`, and `convert` of the Python module.
#pragma once

#include <string>

#include "formats/import_options.h"
#include "formats/scene_file.h"

namespace hooke {

// `in` is a file or the id of a shipped scene; the extension of `out` determines the format. Returns the scene as it was read, with
// warnings about the file, and about what the format cannot represent. Throws UsageError, InputError, FileError.
LoadedScene convert_file(const std::string& in, const std::string& out, const ImportOptions& options = {});

}  // namespace hooke
