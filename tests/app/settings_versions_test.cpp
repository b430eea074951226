// Settings of every version stay readable, and those of a later version are refused with that version.
#include <gtest/gtest.h>

#include "app/document/preferences.h"
#include "base/errors.h"
#include "support/contents.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

const Preferences kept{.interface_scale = 1.5, .autosave_seconds = 20.0, .light = true, .system_dialogs = true};

Preferences read(const std::string& name) { return parse_preferences(contents(HOOKE_OLD_SETTINGS "/" + name), name); }

// These files are never changed, and a new version of the format adds one.
TEST(SettingsVersions, AFileOfEachIsRead) {
  EXPECT_EQ(read("settings_0_1_0.json"), kept) << "0.1 wrote no version";
  for (int version = 1; version <= newest_settings_version; ++version)
    EXPECT_EQ(read("settings_" + std::to_string(version) + ".json"), kept) << version;
  Preferences quiet = kept;
  quiet.measure_accuracy = false;
  EXPECT_EQ(read("settings_1_measure_accuracy.json"), quiet) << "a preference that was added later";
}

TEST(SettingsVersions, TheNewestIsWrittenAsItIsKept) {
  const ScratchFolder scratch;
  Preferences quiet = kept;
  quiet.measure_accuracy = false;
  save_preferences(quiet, scratch.folder);
  EXPECT_EQ(contents(scratch.folder / "settings.json"), contents(HOOKE_OLD_SETTINGS "/settings_1_measure_accuracy.json"));
}

TEST(SettingsVersions, ALaterOneIsNamed) {
  const auto refusal = [](const std::string& text) {
    try {
      parse_preferences(text, "settings.json");
    } catch (const InputError& refused) {
      return std::string(refused.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refusal(R"({"hooke_settings": 7, "light": "blue"})"),
            "settings.json: hooke_settings: 7: must be at most 1: settings of version 7 need a newer Hooke");
  for (const char* no_version : {"0", "0.5", "-1", "null", "\"1\""})
    EXPECT_EQ(refusal("{\"hooke_settings\": " + std::string(no_version) + "}").find("settings.json: hooke_settings: "), 0u) << no_version;
}

}  // namespace
}  // namespace hooke
