// The preferences of the user and the list of recent files: two small JSON files.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hooke {

struct Preferences {
  double interface_scale = 1.0;    // [1], scale of panels and text
  double autosave_seconds = 30.0;  // [s], time from a change to the autosave
  bool light = false;              // light theme
  bool system_dialogs = false;     // use the file dialog of the desktop if there is one
  bool measure_accuracy = true;    // of every run
  bool operator==(const Preferences&) const = default;
};

// The numbers and switches. To add one: a field, and a row in preferences.cpp.
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

// Version of the settings that this program writes; it reads every version up to this one. Settings without a version were written by
// Hooke 0.1 and are read as version 1. A new preference needs no new version: programs that do not know it ignore it.
inline constexpr int newest_settings_version = 1;

// Parses a settings file; `name` is its name in messages. Throws InputError.
Preferences parse_preferences(const std::string& text, const std::string& name);

struct LoadedPreferences {
  Preferences preferences;
  std::string message;  // empty, or the reason why the file was not used
};

// From `folder`/settings.json. An invalid file is renamed to settings.json.bad, and the defaults are returned.
LoadedPreferences load_preferences(const std::filesystem::path& folder);

// Throws FileError.
void save_preferences(const Preferences& preferences, const std::filesystem::path& folder);

// Newest first, without duplicates.
class RecentFiles {
 public:
  // Stored in `folder`/recent.json, or only in memory if the folder is empty. An unreadable file counts as an empty list.
  explicit RecentFiles(std::filesystem::path folder);

  // Errors of writing the file are ignored.
  void add(const std::filesystem::path& file);
  void remove(const std::filesystem::path& file);
  const std::vector<std::filesystem::path>& files() const { return files_; }

  static constexpr std::size_t max = 12;

 private:
  void save() const;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace hooke
