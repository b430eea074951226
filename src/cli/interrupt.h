// Ctrl+C in long commands that save their results.
#pragma once

#include "lab/lab.h"

namespace hooke {

// From now on the first Ctrl+C or SIGTERM requests a stop; a second one terminates the program.
void catch_interrupts();
bool was_interrupted();
// As shells report the signal: 130 after Ctrl+C, 143 after SIGTERM.
int exit_interrupted();

void throw_if_interrupted();  // Interrupted

// Makes `step` of the laboratory throw Interrupted, between substeps, once a stop is requested.
void catch_interrupts(Lab& lab);

}  // namespace hooke
