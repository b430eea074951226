// What a person has set once for all, and the files used last: two small JSON files.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hooke {

struct Preferences {
  double interface_scale = 1.0;    // [1], of all panels and their text
  double autosave_seconds = 30.0;  // [s] of changes until they are kept
  bool light = false;              // panels dark on light
  bool system_dialogs = false;     // ask for files with the desktop's own dialog, where there is one
  bool operator==(const Preferences&) const = default;
};

// The numbers among them, and the switches. Adding one: a field and a row here.
struct PreferenceRow {
  std::string_view name;
  double Preferences::*field;
  double min, max;
};
std::span<const PreferenceRow> preference_rows();
struct PreferenceSwitch {
  std::string_view name;
  bool Preferences::*field;
};
std::span<const PreferenceSwitch> preference_switches();

// From the text of such a file; `name` stands for it in messages. Throws InputError.
Preferences parse_preferences(const std::string& text, const std::string& name);

struct LoadedPreferences {
  Preferences preferences;
  std::string message;  // empty, or that the file was set aside, and why
};

// From `folder`/settings.json. What cannot be read is set aside as settings.json.bad, and the usual settings hold.
LoadedPreferences load_preferences(const std::filesystem::path& folder);

// Throws FileError.
void save_preferences(const Preferences& preferences, const std::filesystem::path& folder);

// Newest first, each once.
class RecentFiles {
 public:
  // Kept in `folder`/recent.json; a list that cannot be read is an empty one. An empty folder: in memory alone.
  explicit RecentFiles(std::filesystem::path folder);

  // A file that cannot be written is no reason to stop.
  void add(const std::filesystem::path& file);
  void forget(const std::filesystem::path& file);
  const std::vector<std::filesystem::path>& files() const { return files_; }

  static constexpr std::size_t max = 12;

 private:
  void save() const;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace hooke
