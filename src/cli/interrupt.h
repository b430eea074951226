// Ctrl+C in long commands that save their results.
#pragma once

namespace hooke {

inline constexpr int exit_interrupted = 130;  // as shells report Ctrl+C

// From now on the first Ctrl+C requests a stop; a second one terminates the program.
void catch_interrupts();
bool was_interrupted();

}  // namespace hooke
