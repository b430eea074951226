// Ctrl+C in long commands that save their results.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/lab.h"

namespace hooke {

// From now on the first Ctrl+C or SIGTERM requests a stop; a second one terminates the program.
void catch_interrupts();
bool was_interrupted();
// As shells report the signal: 130 after Ctrl+C, 143 after SIGTERM.
int exit_interrupted();

void throw_if_interrupted();  // Interrupted

// Says on stderr at which time the results end, or the pictures, and in which files (none, or "-": on stdout). Returns the exit code.
int report_interrupted(const std::string& what, const std::vector<std::optional<std::string>>& files, double time);

// Makes `step` of the laboratory throw Interrupted, between substeps, once a stop is requested.
void catch_interrupts(Lab& lab);

}  // namespace hooke
