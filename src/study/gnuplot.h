// Runs gnuplot as a process.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace hooke {

// Text in a script: in single quotes, in which gnuplot interprets nothing except a doubled quote.
std::string gnuplot_text(std::string_view text);

struct GnuplotChart {
  int width, height;   // [px]
  std::string script;  // without terminal and output
};

// Writes a chart to `file`, as SVG or PNG, as its name ends. Returns none on success, else why gnuplot drew none in one line. Throws
// FileError if it was drawn but cannot be written: the exit code of gnuplot does not tell.
std::optional<std::string> draw_chart(const GnuplotChart& chart, const std::filesystem::path& file);

}  // namespace hooke
