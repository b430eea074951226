// The chart of a comparison of methods as a file: vector or pixel image, table, results that `bench` reads.
#include "study/compare_methods.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "study/work_precision_file.h"
#include "support/contents.h"
#include "support/nets.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

MethodComparison compared_net() {
  const TestSim sim = net(4, 1e2, 0.0);
  return compare_methods(sim.system, sim.state, 0.2, {.repeats = 1, .run_seconds = 0.01, .reference_seconds = 0.2, .finest_error = 1e-6},
                         [](double) { return true; });
}

TEST(ComparisonFile, HasTheFormatOfItsExtension) {
  const ScratchFolder scratch;
  const MethodComparison comparison = compared_net();
  ASSERT_FALSE(comparison.record.rows.empty());
  for (const char* name : {"chart.csv", "chart.json", "chart.svg", "chart.png"})
    EXPECT_EQ(write_comparison(comparison, scratch.folder / name), "");
  const Results results = parse_results(contents(scratch.folder / "chart.json"), "chart.json");
  ASSERT_EQ(results.problems.size(), 1u);
  EXPECT_EQ(results.problems[0].rows.size(), comparison.record.rows.size());
  const std::string table = contents(scratch.folder / "chart.csv"), vector = contents(scratch.folder / "chart.svg");
  EXPECT_EQ(std::ranges::count(table, '\n'), static_cast<std::ptrdiff_t>(comparison.record.rows.size() + 1));
  for (const char* method : {"velocity_verlet", "blanes_moan4", "dop853"}) {
    EXPECT_NE(table.find(method), std::string::npos);
    EXPECT_NE(vector.find(method), std::string::npos);
  }
  EXPECT_NE(vector.find("</svg>"), std::string::npos);
  EXPECT_TRUE(contents(scratch.folder / "chart.png").starts_with("\x89PNG"));
}

TEST(ComparisonFile, ThatCannotBeWrittenIsReportedWithItsReason) {
  const ScratchFolder scratch;
  const MethodComparison nothing;
  for (const char* name : {"missing/chart.csv", "missing/chart.svg", "chart.gif"}) {
    EXPECT_NE(write_comparison(nothing, scratch.folder / name), "") << name;
    EXPECT_FALSE(std::filesystem::exists(scratch.folder / name)) << name;
  }
}

}  // namespace
}  // namespace hooke
