// Folders and files to choose from, within a dialog.
#pragma once

#include "ui/panels.h"

namespace hooke {

enum class Browsing { Open, Save };

// Looks where `dialog.browser` is; a chosen file goes to `dialog.typed`. True: it was chosen for good, by a double click.
bool build_browser(const Desk& desk, Dialog& dialog, Browsing browsing);

// What the typed text means, seen from the folder that is shown.
std::filesystem::path meant_by(const Dialog& dialog);

// Shows a folder from now on, and takes the name of a file along.
void go_to_folder(Dialog& dialog, const std::filesystem::path& folder, Browsing browsing);

}  // namespace hooke
