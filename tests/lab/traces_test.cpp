// Traces (what the plots show): quantities over the recorded times.
#include "lab/traces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formats/scene_file.h"
#include "lab/lab.h"
#include "scene/parameters.h"
#include "sim/forces/energy/energy.h"
#include "support/apply_now.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

Quantity quantity(const Lab& lab, const char* name) {
  const System& system = lab.scene().system;
  return *find_quantity(name, system.point_count(), system.spring_count());
}

TEST(Traces, ContainTheMeasurementOfEveryFrame) {
  Lab lab = lab_on("two_masses");
  lab.submit(Watch{{quantity(lab, "total"), quantity(lab, "y1")}});
  for (int frame = 0; frame < 10; ++frame) {
    lab.step();
    lab.publish();
    const TraceTable& table = *lab.status()->timeline.traces;
    EXPECT_EQ(table.times.back(), lab.scene().state.time);
    EXPECT_EQ(table.traces[0].values.back(), compute_energy(lab.scene().system, lab.scene().state).total());
    EXPECT_EQ(table.traces[1].values.back(), lab.scene().state.position[1].y);
  }
  EXPECT_EQ(lab.status()->timeline.traces->times.size(), 11u);  // including the start
}

TEST(Traces, OfDissipatedAndRemainingEnergyAddUpToTheInitialEnergy) {
  Lab lab = lab_on("two_masses");
  lab.submit(SetParameter{find_parameter("drag"), 1.0});
  lab.submit(Watch{{quantity(lab, "dissipated"), quantity(lab, "total")}});
  for (int frame = 0; frame < 30; ++frame) lab.step();
  lab.publish();
  const TraceTable& table = *lab.status()->timeline.traces;
  const auto& lost = table.traces[0].values;
  const auto& total = table.traces[1].values;
  EXPECT_GT(lost.back(), 0.01);
  for (std::size_t i = 0; i < lost.size(); ++i) EXPECT_NEAR(lost[i] + total[i], total.front(), 1e-9 * std::abs(total.front()) + 1e-12);
}

TEST(Traces, IncludeThePastOfQuantitiesChosenLater) {
  Lab lab = lab_on("two_masses");
  for (int frame = 0; frame < 10; ++frame) lab.step();
  lab.submit(Watch{{quantity(lab, "kinetic")}});
  apply_now(lab);
  const TraceTable& table = *lab.status()->timeline.traces;
  ASSERT_EQ(table.times.size(), 11u);
  EXPECT_EQ(table.times.front(), 0.0);
  EXPECT_EQ(table.traces[0].values.front(), 0.0);
}

TEST(Traces, ContinueFromThePastAfterGoingBack) {
  Lab lab = lab_on("two_masses");
  lab.submit(Watch{{quantity(lab, "kinetic")}});
  for (int frame = 0; frame < 10; ++frame) lab.step();
  lab.submit(GoToTime{0.1});
  lab.submit(SetParameter{find_parameter("gravity"), 1.0});
  lab.step();
  lab.publish();
  const TraceTable& table = *lab.status()->timeline.traces;
  EXPECT_TRUE(std::ranges::is_sorted(table.times));
  EXPECT_EQ(table.times.back(), lab.scene().state.time);
  EXPECT_EQ(table.times.size(), table.traces[0].values.size());
}

TEST(Traces, AreExportedAsCsvWithUnitsAndEmptyCellsForMissingValues) {
  TraceTable table;
  table.times = {0.0, 0.5};
  table.traces = {{*find_quantity("total", 2, 1), {1.25, std::nan("")}}, {*find_quantity("y1", 2, 1), {-3.0, 1e-300}}};
  EXPECT_EQ(to_csv(table), "time [s],total [J],y1 [m]\n0,1.25,-3\n0.5,,1e-300\n");
}

TEST(Traces, AreAsLongAsTheTimeline) {
  Lab lab = lab_on("two_masses");
  lab.submit(Watch{{quantity(lab, "kinetic")}});
  for (std::size_t frame = 0; frame < Timeline::max_states + 1000; ++frame) lab.step();
  lab.publish();
  const std::size_t count = lab.status()->timeline.traces->times.size();
  EXPECT_GE(count, Timeline::max_states);
  EXPECT_LT(count, Timeline::max_states + 300);
}

}  // namespace
}  // namespace hooke
