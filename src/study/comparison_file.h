// Writes a comparison of methods to a file, in the formats of `hooke bench`.
#pragma once

#include <filesystem>
#include <string>

#include "study/compare_methods.h"

namespace hooke {

// By the extension of the file: .csv and .json values, .svg and .png the chart, which needs gnuplot. Returns the reason in one line if it
// cannot be written, else an empty string.
std::string write_comparison(const MethodComparison& comparison, const std::filesystem::path& file);

}  // namespace hooke
