// How a mesh is read. The table is the options of the command line, the arguments of Python and the fields of the open dialog.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace hooke {

struct ImportOptions {
  double seam_distance = 0.0;  // [m], of vertices on open edges that are joined
  double scale = 1.0;          // [m], of one unit of the file
  bool is_z_up = false;        // the file has z up, and y to the back
  bool operator==(const ImportOptions&) const = default;
};

struct ImportOption {
  std::string_view name;   // "weld", also the name of an argument
  std::string_view value;  // "METERS"
  std::string_view description;
  void (*set)(ImportOptions& options, const std::string& text);  // throws OptionError
};

std::span<const ImportOption> import_options();

}  // namespace hooke
