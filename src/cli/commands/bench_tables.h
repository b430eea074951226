// What `bench` measures instead of methods on scenes. Each prints a table unless `quiet`, writes a .csv file of its name into the folder,
// takes fewer and smaller cases if `quick`, and returns the exit code.
#pragma once

#include <filesystem>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#include "batch/machine.h"
#include "batch/scene_options.h"
#include "sim/methods/integrator.h"

namespace hooke {

// The largest cloth that each method steps in real time with an error of at most `relative_error` [1].
int bench_capacity(const std::filesystem::path& folder, std::span<const Integrator* const> methods, double relative_error, bool quick,
                   bool quiet);
// How long edits of running cloths take to be seen.
int bench_edits(const std::filesystem::path& folder, bool quick, bool quiet);
// The time of a step of several kinds of cloth.
int bench_kernels(const std::filesystem::path& folder, Device device, bool quick, bool quiet);
// What measuring the accuracy costs with these methods on these scenes, or the default ones if there are none.
int bench_overhead(const std::filesystem::path& folder, const std::vector<std::string>& scenes,
                   const std::vector<const Integrator*>& methods, bool quick, bool quiet);
// Time and memory of cloths of 1e3 to 4e6 springs.
int bench_scaling(const std::filesystem::path& folder, bool quick, bool quiet);

// The head of a table for a terminal: the machine, and `title` before a column for each of `columns`, by its name.
template <class Columns, class Name>
void print_head(std::string_view title, const Columns& columns, const Name& name) {
  std::cout << machine() << "\n\n| " << title << " |";
  for (const auto& column : columns) std::cout << " " << name(column) << " |";
  std::cout << "\n|---|";
  for (std::size_t i = 0; i < columns.size(); ++i) std::cout << "---|";
  std::cout << "\n";
}
inline std::string size_text(int n) { return std::to_string(n) + " x " + std::to_string(n); }

}  // namespace hooke
