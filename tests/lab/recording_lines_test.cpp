// The lines of a recording, without a session.
#include <gtest/gtest.h>

#include <string>

#include "base/errors.h"
#include "lab/recording.h"

namespace hooke {
namespace {

// The limit on the values of one item is that of a point, not of the list.
TEST(Recording, MayHaveALargeScene) {
  std::string points;
  for (int i = 0; i < 210000; ++i) points += (i > 0 ? "," : "") + std::string("{\"position\":[0,0,0]}");
  try {
    parse_recording("{\"hooke_recording\": 1}\n{ \"points\":[" + points + "],\"hooke\":1}\n", "x.hookelog");
    FAIL() << "has no rest";
  } catch (const InputError& refused) {
    EXPECT_STREQ(refused.what(), "x.hookelog: line 2: must continue with the rest of the scene: {\"rest\": ...}");
  }
}

}  // namespace
}  // namespace hooke
