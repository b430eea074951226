// Wind on rows of faces, by vectors: the same bits as face by face.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>

#include "sim/forces/terms/rows.h"
#include "sim/forces/terms/wind_kernel.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

// Points in rows with two faces in each cell, which make a quad, in random places; some nailed, some cells without an area. With
// `separated`, faces without an area are between them, so that none form a row.
TestSim sheet_of_faces(int rows, int columns, bool separated) {
  Random random(static_cast<std::uint64_t>(100 * rows + columns));
  TestSim sim;
  for (int i = 0; i < rows * columns; ++i) {
    const double x = random.uniform(-1.0, 1.0), y = random.uniform(-1.0, 1.0), z = random.uniform(-1.0, 1.0);
    const Vec3 position = i > 0 && random.one_in(5) ? sim.state.position.back() : Vec3(x, y, z);
    random.one_in(7) ? sim.nail(position) : sim.add(position, random.uniform(0.1, 1.0), {z, x, y});
  }
  const auto id = [&](int row, int column) { return sim.system.points()[static_cast<std::size_t>(row * columns + column)].id; };
  for (int row = 0; row + 1 < rows; ++row)
    for (int column = 0; column + 1 < columns; ++column) {
      sim.system.faces.push_back({{id(row, column), id(row + 1, column), id(row, column + 1)}});
      sim.system.faces.push_back({{id(row, column + 1), id(row + 1, column), id(row + 1, column + 1)}});
      if (separated) sim.system.faces.push_back({{id(row, column), id(row, column), id(row, column)}});
    }
  sim.system.forces = {{.term = &wind_force, .values = {2.0, 1.0, -3.0, 0.6, 0.1, 0.0, 1.0, 1.0}}};
  return sim;
}

struct Result {
  Field force;
  double power = 0.0;
  Index rows = 0;
};

Result wind_on(const TestSim& sim) {
  const Plan plan = make_plan(sim.system);
  Motion motion;
  pack(plan, sim.state, motion);
  const ForceValues& values = plan.forces[0].values;
  Result result{.force = motion.v};
  wind_force.add(plan, values, 0.0, motion.x.data(), motion.v.data(), result.force.data());
  result.power = wind_force.power(plan, values, 0.0, motion.x.data(), motion.v.data());
  result.rows = static_cast<Index>(plan.force_data.panel_rows.size());
  return result;
}

TEST(WindRows, HaveTheBitsOfQuadsOneByOneOnEveryVectorUnit) {
  for (const int dimensions : {3, 2})
    for (const auto& [rows, columns] : {std::pair{2, 5}, {9, 6}, {5, 17}, {4, 23}, {3, 300}}) {
      TestSim in_rows = sheet_of_faces(rows, columns, false), separated = sheet_of_faces(rows, columns, true);
      in_rows.system.dimensions = separated.system.dimensions = dimensions;
      const Result expected = wind_on(separated);
      EXPECT_EQ(expected.rows, 0);
      double first_power = 0.0;
      for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().DeInit();
        const Result result = wind_on(in_rows);
        EXPECT_GE(result.rows, rows - 1);
        EXPECT_EQ(result.force, expected.force) << rows << " x " << columns << ", " << hwy::TargetName(target);
        EXPECT_NEAR(result.power, expected.power, 1e-12 * rows * columns);
        if (first_power == 0.0) first_power = result.power;
        EXPECT_EQ(result.power, first_power) << hwy::TargetName(target);
      }
      hwy::SetSupportedTargetsForTest(0);
      hwy::GetChosenTarget().DeInit();
    }
}

}  // namespace
}  // namespace hooke
