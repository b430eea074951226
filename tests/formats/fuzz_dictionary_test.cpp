// The dictionary of the scene fuzzer contains every key that the reader knows. Words of tables are added by the fuzz tests.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>

#include "support/contents.h"

namespace hooke {
namespace {

std::set<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), pattern); at != std::sregex_iterator(); ++at) found.insert((*at)[1]);
  return found;
}

// The keys that the sources of the reader compare with or require.
std::set<std::string> keys_in_sources() {
  const std::filesystem::path sources = DOCS_FOLDER "/../src/formats";
  std::string text = contents(sources / "gallery.cpp") + contents(sources / "scene_check.cpp");
  for (const auto& entry : std::filesystem::directory_iterator(sources / "scene_json")) text += contents(entry.path());
  return matches(text, std::regex(R"re(\b(?:is|refuse_missing)\("(\w+)")re"));
}

TEST(FuzzDictionary, HasEveryKeyOfTheSceneFormat) {
  const std::set<std::string> keys = keys_in_sources();
  for (const char* key : {"gallery", "thumbnail_seconds", "position"}) EXPECT_TRUE(keys.contains(key)) << key;
  const std::set<std::string> words = matches(contents(FUZZ_FOLDER "/scene.dict"), std::regex(R"re(\\"(\w+)\\")re"));
  for (const std::string& key : keys) EXPECT_TRUE(words.contains(key)) << "tests/fuzz/scene.dict lacks " << key;
}

}  // namespace
}  // namespace hooke
