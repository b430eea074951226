#include "formats/import_options.h"

#include "base/option_error.h"
#include "base/printable.h"
#include "base/text_lines.h"

namespace hooke {
namespace {

double number_of(const char* option, const std::string& text, const Bounds& bounds) {
  const auto number = parse_number(text);
  if (!number) throw OptionError(option, printable(text, 80), "not a number: " + bounds.text());
  check_option(option, *number, bounds);
  return *number;
}

constexpr ImportOption rows[] = {
    {"weld", "METERS", "For a mesh: join the points of open edges that are closer than this [m]",
     [](ImportOptions& options, const std::string& text) { options.seam_distance = number_of("weld", text, not_negative); }},
    {"scale", "METERS", "For a mesh: length of its unit [m], 0.001 for millimeters",
     [](ImportOptions& options, const std::string& text) { options.scale = number_of("scale", text, positive); }},
    {"up", "AXIS", "For a mesh: the axis that points up, y or z",
     [](ImportOptions& options, const std::string& text) {
       if (text != "y" && text != "z") throw OptionError("up", printable(text, 80), "must be y or z");
       options.is_z_up = text == "z";
     }},
};

}  // namespace

std::span<const ImportOption> import_options() { return rows; }

}  // namespace hooke
