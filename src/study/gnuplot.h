// Runs gnuplot as a process, without a shell.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace hooke {

// Runs a script with `folder` as working directory. Returns none on success, else the reason in one line.
std::optional<std::string> run_gnuplot(const std::string& script, const std::filesystem::path& folder);

}  // namespace hooke
