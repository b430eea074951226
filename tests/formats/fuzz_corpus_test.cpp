// Replays every input in the corpora of the fuzzers.

#include <gtest/gtest.h>

#include <filesystem>

#include "fuzz/obj_input.h"
#include "fuzz/png_input.h"
#include "fuzz/recording_input.h"
#include "fuzz/scene_input.h"
#include "fuzz/settings_input.h"
#include "fuzz/xml_input.h"
#include "fuzz/xsp_input.h"
#include "support/contents.h"

namespace hooke {
namespace {

// Tries every file of a folder and returns their number.
int replay(const std::string& format, void (*try_as)(std::string_view bytes)) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FUZZ_FOLDER "/corpus/" + format)) {
    SCOPED_TRACE(entry.path().filename().string());
    try_as(contents(entry.path()));
    ++count;
  }
  return count;
}

TEST(FuzzCorpus, EverySceneIsLoadedOrRefused) { EXPECT_GT(replay("scene", try_as_scene), 20); }
TEST(FuzzCorpus, EveryXspIsLoadedOrRefused) { EXPECT_GT(replay("xsp", try_as_xsp), 10); }
TEST(FuzzCorpus, EveryXmlIsLoadedOrRefused) { EXPECT_GT(replay("xml", try_as_xml), 10); }
TEST(FuzzCorpus, EveryPngIsDecodedOrRefused) { EXPECT_GT(replay("png", try_as_png), 10); }
TEST(FuzzCorpus, EverySettingsFileIsReadOrRefused) { EXPECT_GT(replay("settings", try_as_settings), 10); }
TEST(FuzzCorpus, EveryRecordingIsPlayedOrRefused) { EXPECT_GT(replay("recording", try_as_recording), 10); }
TEST(FuzzCorpus, EveryObjIsLoadedOrRefused) { EXPECT_GT(replay("obj", try_as_obj), 10); }

}  // namespace
}  // namespace hooke
