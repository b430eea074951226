// Every input that ever taught the fuzzers something, replayed.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "fuzz/scene_input.h"

namespace hooke {
namespace {

TEST(FuzzCorpus, EverySceneIsLoadedOrRefused) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FUZZ_CORPUS "/scene")) {
    SCOPED_TRACE(entry.path().filename().string());
    std::ostringstream bytes;
    bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    try_as_scene(bytes.str());
    ++count;
  }
  EXPECT_GT(count, 20);
}

}  // namespace
}  // namespace hooke
