// Every file reader under random mutations of its corpus, for a second per format. The sequence of mutations is the same in every run.
// scripts/fuzz goes deeper, with coverage feedback from the compiler.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "fuzz/mutation.h"
#include "fuzz/obj_input.h"
#include "fuzz/png_input.h"
#include "fuzz/recording_input.h"
#include "fuzz/scene_input.h"
#include "fuzz/settings_input.h"
#include "fuzz/table_words.h"
#include "fuzz/xml_input.h"
#include "fuzz/xsp_input.h"
#include "support/contents.h"

namespace hooke {
namespace {

// [s] per format; scripts/fuzz takes longer. HOOKE_FUZZ_SECONDS overrides it.
double budget() {
  const char* given = std::getenv("HOOKE_FUZZ_SECONDS");
  return given != nullptr ? std::atof(given) : 1.0;
}

std::vector<std::string> read_all(const std::filesystem::path& folder, std::uintmax_t max_bytes) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file() && entry.file_size() <= max_bytes) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const auto& file : files) {
    texts.push_back(contents(file));
  }
  return texts;
}

// If an input ends the process, that input is in the working folder.
void fuzz(const std::string& format, std::vector<std::string> seeds, void (*try_as)(std::string_view bytes),
          const std::vector<std::string>& table_words = {}) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which reserve far more
  // an input that takes more memory or time is a finding
  const rlimit memory{6ull << 30, 6ull << 30};
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &memory), 0);
#endif
  const std::filesystem::path last = "fuzzed_last." + format;
  std::vector<std::string> words = read_dictionary(FUZZ_FOLDER "/" + format + ".dict");
  words.insert(words.end(), table_words.begin(), table_words.end());
  Mutator mutator(std::move(seeds), std::move(words));
  const auto start = std::chrono::steady_clock::now();
  long tried = 0;
  for (; std::chrono::steady_clock::now() - start < std::chrono::duration<double>(budget()); ++tried) {
    const std::string bytes = mutator.next();
    std::ofstream(last, std::ios::binary) << bytes;
    ::alarm(120);
    try_as(bytes);
  }
  ::alarm(0);
  std::filesystem::remove(last);
  testing::Test::RecordProperty("tried", static_cast<int>(tried));
  EXPECT_GT(tried, 20);
}

TEST(Fuzzed, Scenes) {
  auto seeds = read_all(FUZZ_FOLDER "/corpus/scene", 20'000);
  const auto shipped = read_all(SCENES_FOLDER, 4'000);
  seeds.insert(seeds.end(), shipped.begin(), shipped.end());
  fuzz("scene", seeds, try_as_scene, scene_table_words());
}
TEST(Fuzzed, Recordings) {
  fuzz("recording", read_all(FUZZ_FOLDER "/corpus/recording", 20'000), try_as_recording, recording_table_words());
}
TEST(Fuzzed, Settings) { fuzz("settings", read_all(FUZZ_FOLDER "/corpus/settings", 20'000), try_as_settings); }
TEST(Fuzzed, Xsp) { fuzz("xsp", read_all(FUZZ_FOLDER "/corpus/xsp", 20'000), try_as_xsp); }
TEST(Fuzzed, Xml) { fuzz("xml", read_all(FUZZ_FOLDER "/corpus/xml", 20'000), try_as_xml); }
TEST(Fuzzed, Obj) { fuzz("obj", read_all(FUZZ_FOLDER "/corpus/obj", 20'000), try_as_obj); }
TEST(Fuzzed, Png) { fuzz("png", read_all(FUZZ_FOLDER "/corpus/png", 20'000), try_as_png); }

TEST(Mutations, AreReproducibleAndChangeTheInput) {
  const std::vector<std::string> seeds{"{\"a\": 12.5}"}, words{"true"};
  Mutator one(seeds, words), other(seeds, words);
  int changed = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::string bytes = one.next();
    EXPECT_EQ(bytes, other.next());
    changed += bytes != seeds[0];
  }
  EXPECT_GT(changed, 900);
}

TEST(Mutations, ReadDictionariesLikeLibFuzzer) {
  const auto words = read_dictionary(FUZZ_FOLDER "/png.dict");
  EXPECT_NE(std::find(words.begin(), words.end(), "\x89PNG\r\n\x1a\n"), words.end());
  EXPECT_NE(std::find(words.begin(), words.end(), "IHDR"), words.end());
}

}  // namespace
}  // namespace hooke
