// A list of folders and files, within a dialog.
#pragma once

#include "ui/panels.h"

namespace hooke {

enum class FileDialogMode { Open, Save };

// Shows the folder of `dialog.browser`; a selected file is copied to `dialog.typed`. Returns true if it was confirmed by a double click.
bool build_browser(const PanelInput& input, Dialog& dialog, FileDialogMode mode);

// The typed path, relative to the folder shown.
std::filesystem::path resolved_path(const Dialog& dialog);

// Shows another folder; when saving, keeps the file name.
void go_to_folder(Dialog& dialog, const std::filesystem::path& folder, FileDialogMode mode);

}  // namespace hooke
