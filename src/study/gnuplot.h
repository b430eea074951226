// Runs gnuplot as a process.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace hooke {

// Text in a script: in single quotes, in which gnuplot interprets nothing except a doubled quote.
std::string gnuplot_text(std::string_view text);

// Draws the chart of a script, which must name no output, and writes it to `file`. Returns none on success, else why gnuplot drew none in
// one line. Throws FileError if it was drawn but cannot be written: the exit code of gnuplot does not tell.
std::optional<std::string> draw_chart(const std::string& script, const std::filesystem::path& file);

}  // namespace hooke
