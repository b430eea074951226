// The folders for settings and state, as in the XDG Base Directory Specification. Never the working folder.
#pragma once

#include <filesystem>

namespace hooke {

struct Home {
  std::filesystem::path config;  // settings.json
  std::filesystem::path state;   // recent files and autosaves; empty if nothing is saved
};

// XDG_CONFIG_HOME and XDG_STATE_HOME if they are absolute, otherwise .config and .local/state in HOME. Both are empty without HOME.
Home xdg_home();

// Creates the folder and its parents, accessible to the user only. False if that fails.
bool make_private_folder(const std::filesystem::path& folder);

}  // namespace hooke
