// Ctrl+C in commands that take long and keep what is done.
#pragma once

namespace hooke {

inline constexpr int exit_interrupted = 130;  // as a shell reports Ctrl+C

// From now on Ctrl+C asks to stop; a second one ends the program as it stands.
void catch_interrupts();
bool was_interrupted();

}  // namespace hooke
