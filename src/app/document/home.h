// Where Hooke keeps things from one run to the next: the folders that the XDG Base Directory Specification names. Never
// the working folder.
#pragma once

#include <filesystem>

namespace hooke {

struct Home {
  std::filesystem::path config;  // settings.json
  std::filesystem::path state;   // recent files, and what runs of Hooke keep there; empty: nothing is kept
};

// XDG_CONFIG_HOME and XDG_STATE_HOME where they are absolute, else .config and .local/state in HOME; of a person without a
// home both are empty.
Home xdg_home();

// Makes it and what it lies in, for the person alone. Whether it is there.
bool make_private_folder(const std::filesystem::path& folder);

}  // namespace hooke
