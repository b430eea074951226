// Folders and files to choose from, within a dialog.
#pragma once

#include "ui/panels.h"

namespace hooke {

enum class FileDialogMode { Open, Save };

// Looks where `dialog.browser` is; a chosen file goes to `dialog.typed`. True: it was chosen for good, by a double click.
bool build_browser(const PanelInput& input, Dialog& dialog, FileDialogMode mode);

// What the typed text means, seen from the folder that is shown.
std::filesystem::path resolved_path(const Dialog& dialog);

// Shows a folder from now on, and takes the name of a file along.
void go_to_folder(Dialog& dialog, const std::filesystem::path& folder, FileDialogMode mode);

}  // namespace hooke
