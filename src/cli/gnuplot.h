// gnuplot as a process of its own, without a shell.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace hooke {

// Runs a script with `folder` as the working folder. None when it worked, else why not, in one line.
std::optional<std::string> run_gnuplot(const std::string& script, const std::filesystem::path& folder);

}  // namespace hooke
