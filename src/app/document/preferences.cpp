#include "app/document/preferences.h"

#include <algorithm>
#include <array>

#include "app/document/home.h"
#include "base/atomic_write.h"
#include "base/bounds.h"
#include "base/errors.h"
#include "base/json_field.h"
#include "base/json_writer.h"
#include "base/printable.h"
#include "base/read_file.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

constexpr std::array rows{
    PreferenceRow{"interface_scale", &Preferences::interface_scale, 0.75, 3.0},
    PreferenceRow{"autosave_seconds", &Preferences::autosave_seconds, 1.0, 60.0},
};

constexpr std::array switches{
    PreferenceSwitch{"light", &Preferences::light},
    PreferenceSwitch{"system_dialogs", &Preferences::system_dialogs},
    PreferenceSwitch{"measure_accuracy", &Preferences::measure_accuracy},
};

constexpr std::string_view settings_name = "settings.json", recent_name = "recent.json", version_name = "hooke_settings";

void check_version(const JsonField& field) {
  if (field.number() > newest_settings_version)
    field.refuse("must be at most " + std::to_string(newest_settings_version) + ": settings of version " + format_exact(field.number()) +
                 " need a newer Hooke");
  field.integer(1, newest_settings_version);
}

void read_preference(const JsonField& field, Preferences& preferences) {
  if (field.is(version_name)) check_version(field);
  for (const PreferenceSwitch& row : switches)
    if (field.is(row.name)) preferences.*row.field = field.boolean();
  for (const PreferenceRow& row : rows)
    if (field.is(row.name)) preferences.*row.field = field.number({.min = row.min, .max = row.max});
}

}  // namespace

std::span<const PreferenceRow> preference_rows() { return rows; }
std::span<const PreferenceSwitch> preference_switches() { return switches; }

Preferences parse_preferences(const std::string& text, const std::string& name) {
  Preferences preferences;
  read_members(text, name, [&](const JsonField& field) { read_preference(field, preferences); });
  return preferences;
}

LoadedPreferences load_preferences(const fs::path& folder) {
  LoadedPreferences loaded;
  const fs::path file = folder / settings_name;
  std::error_code error;
  if (folder.empty() || !fs::exists(fs::symlink_status(file, error))) return loaded;
  try {
    loaded.preferences = parse_preferences(read_file(file), printable(file.native()));
  } catch (const std::runtime_error& refusal) {  // InputError or FileError
    const fs::path aside = file.string() + ".bad";
    fs::rename(file, aside, error);
    loaded.message =
        std::string(refusal.what()) + "\n\nHooke uses the default settings. " +
        (error ? "The file could not be renamed: " + error.message() + "." : "The file was renamed to " + printable(aside.native()) + ".");
  }
  return loaded;
}

void save_preferences(const Preferences& preferences, const fs::path& folder) {
  if (folder.empty()) return;
  JsonWriter writer;
  writer.begin_object(JsonWriter::Layout::Lines);
  writer.integer(version_name, newest_settings_version);
  for (const PreferenceRow& row : rows) writer.number(row.name, preferences.*row.field);
  for (const PreferenceSwitch& row : switches) writer.boolean(row.name, preferences.*row.field);
  writer.end();
  make_private_folder(folder);
  write_atomically(folder / settings_name, writer.take() + "\n");
}

RecentFiles::RecentFiles(fs::path folder) : folder_(std::move(folder)) {
  if (folder_.empty()) return;
  try {
    const fs::path file = folder_ / recent_name;
    read_members(read_file(file), printable(file.native()), [&](const JsonField& field) {
      if (!field.is("files")) return;
      for (const JsonField item : field.items(0, max)) files_.emplace_back(std::string(item.text()));
    });
  } catch (const std::runtime_error&) {  // InputError or FileError
    files_.clear();
  }
}

void RecentFiles::add(const fs::path& file) {
  std::erase(files_, file);
  files_.insert(files_.begin(), file);
  if (files_.size() > max) files_.resize(max);
  save();
}

void RecentFiles::remove(const fs::path& file) {
  if (std::erase(files_, file) > 0) save();
}

void RecentFiles::save() const {
  if (folder_.empty()) return;
  JsonWriter writer;
  writer.begin_object(JsonWriter::Layout::Lines);
  writer.list("files", JsonWriter::Layout::Lines, files_, [&](const fs::path& file) {
    // JSON requires UTF-8
    if (is_utf8(file.native())) writer.text(file.native());
  });
  writer.end();
  try {
    make_private_folder(folder_);
    write_atomically(folder_ / recent_name, writer.take() + "\n");
  } catch (const FileError&) {
  }
}

}  // namespace hooke
