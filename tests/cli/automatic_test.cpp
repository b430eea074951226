// The method `auto` on the command line.
#include <gtest/gtest.h>

#include <sstream>

#include "support/headless.h"

namespace hooke {
namespace {

Outcome run_with(const std::string& arguments) {
  std::vector<std::string> words{HOOKE_HEADLESS};
  std::istringstream text(arguments);
  for (std::string word; text >> word;) words.push_back(word);
  return run_process(words);
}

// Without a named method, a tolerance selects auto; the summary says what it chose; the same bits every time.
TEST(AutomaticMethod, IsSelectedByATolerance) {
  const Outcome first = run_with("run cloth --seconds 0.5 --tolerance 1e-3"), again = run_with("run cloth --seconds 0.5 --integrator auto");
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_NE(first.out.find("auto, tolerance 0.001 m/s"), std::string::npos) << first.out;
  EXPECT_NE(first.out.find("last choice: "), std::string::npos) << first.out;
  EXPECT_EQ(first.out.substr(first.out.find("hash ")), again.out.substr(again.out.find("hash ")));
}

// A tolerance that no method can meet is not passed over in silence.
TEST(AutomaticMethod, SaysWhereTheToleranceIsNotMet) {
  const Outcome run = run_with("run two_masses --seconds 0.01 --tolerance 1e-30");
  EXPECT_EQ(run.code, 4) << run.out;
  EXPECT_NE(run.err.find("the tolerance was not met in 1 of 1 frames"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace hooke
