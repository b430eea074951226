// What lies in a folder, for a dialog that asks for a file; and what a typed path means there.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hooke {

struct FolderItem {
  std::string name;
  bool is_folder = false;
  std::string modified;  // "2026-11-21 15:20"; empty: unknown
};

struct FolderListing {
  std::filesystem::path folder;
  std::vector<FolderItem> items;  // folders first, each part by name
  std::string error;              // why it cannot be looked into
  bool truncated = false;         // it holds more
};

// Without hidden items, and of files only the wanted ones; at most `most` items.
FolderListing list_folder(const std::filesystem::path& folder, const std::function<bool(const std::filesystem::path& file)>& is_wanted,
                          std::size_t max_items = 5000);

// "~/" is the home folder, a missing ending is .json unless there is such a file or folder, the rest starts from `folder`.
std::filesystem::path resolve_typed_path(const std::filesystem::path& typed, const std::filesystem::path& folder);

// The folder of the person, or the root.
std::filesystem::path home_folder();

}  // namespace hooke
