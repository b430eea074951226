// The main loop of the window: events in, frames out, until the user quits.
#pragma once

#include "app/app.h"
#include "app/window/window.h"

namespace hooke {

// Throws WindowError if the graphics cannot be used.
void run_loop(Window& window, App& app);

}  // namespace hooke
