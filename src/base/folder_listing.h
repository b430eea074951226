// Lists folders for file dialogs, and resolves typed paths.
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
  std::vector<FolderItem> items;  // folders first, then files, each sorted by name
  std::string error;              // why it cannot be read
  bool truncated = false;         // there are more items
};

// Without hidden items, and only the wanted files; at most `max` items.
FolderListing list_folder(const std::filesystem::path& folder, const std::function<bool(const std::filesystem::path& file)>& is_wanted,
                          std::size_t max_items = 5000);

// "~/" is the home folder; a missing extension is .json unless the file or folder exists; relative paths start at `folder`.
std::filesystem::path resolve_typed_path(const std::filesystem::path& typed, const std::filesystem::path& folder);

// The home folder, or the root.
std::filesystem::path home_folder();

}  // namespace hooke
