#include "base/folder_listing.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <tuple>

namespace hooke {
namespace {

namespace fs = std::filesystem;

std::string time_text(const fs::directory_entry& entry) {
  std::error_code error;
  const fs::file_time_type modified = entry.last_write_time(error);
  if (error) return {};
  const std::time_t seconds = std::chrono::system_clock::to_time_t(std::chrono::file_clock::to_sys(modified));
  std::tm local{};
  char text[64];
  return ::localtime_r(&seconds, &local) != nullptr && std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local) > 0 ? text : "";
}

// For sorting names without regard to case.
std::string to_lower(const std::string& name) {
  std::string lower = name;
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : static_cast<char>(c); });
  return lower;
}

}  // namespace

FolderListing list_folder(const fs::path& folder, const std::function<bool(const fs::path& file)>& is_wanted, std::size_t max_items) {
  FolderListing listing{folder, {}, {}, false};
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename();
    std::error_code ignored;
    const bool is_folder = entry->is_directory(ignored);
    if (name.starts_with('.') || (!is_folder && !(entry->is_regular_file(ignored) && is_wanted(entry->path())))) continue;
    listing.truncated = listing.items.size() >= max_items;
    if (listing.truncated) break;
    listing.items.push_back({name, is_folder, time_text(*entry)});
  }
  if (error) listing.error = error.message();
  std::ranges::sort(listing.items, {}, [](const FolderItem& item) { return std::tuple(!item.is_folder, to_lower(item.name), item.name); });
  return listing;
}

fs::path resolve_typed_path(const fs::path& typed, const fs::path& folder) {
  const std::string& text = typed.native();
  if (text == "~") return home_folder();
  fs::path path = text.starts_with("~/") ? home_folder() / text.substr(2) : folder / typed;
  std::error_code error;
  path = path.lexically_normal();
  if (!path.has_extension() && !fs::exists(path, error) && path.has_filename()) path += ".json";
  return path;
}

fs::path home_folder() {
  const char* home = std::getenv("HOME");
  return home != nullptr && *home == '/' ? fs::path(home) : fs::path("/");
}

}  // namespace hooke
