#include "scene/warnings/warnings.h"

#include <gtest/gtest.h>

#include "sim/forces/force_terms.h"
#include "sim/forces/terms/rows.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

// Two triangles on a square of 1 m, with springs along their edges but the shared one.
TestSim folded_square() {
  TestSim sim;
  const PointId a = sim.add({0.0, 0.0, 0.0}), b = sim.add({1.0, 0.0, 0.0}), c = sim.add({0.0, 0.0, 1.0}), d = sim.add({1.0, 0.0, 1.0});
  for (const auto& [first, second] : {std::pair{a, b}, {a, c}, {b, d}, {c, d}}) sim.join(first, second, 100.0, 1.0);
  sim.system.faces = std::vector<Face>{{{a, c, b}}, {{b, c, d}}};
  sim.system.forces = {{.term = &bending_force, .values = default_values(bending_force)}};
  return sim;
}

TEST(BendingWarning, IsNotGivenWhereItActsOrIsOff) {
  TestSim sim = folded_square();
  EXPECT_EQ(bending_warning(sim.system), std::nullopt);
  sim.system.faces.clear();
  sim.system.forces[0].on = false;
  EXPECT_EQ(bending_warning(sim.system), std::nullopt);
}

TEST(BendingWarning, SaysWhereItDoesNotAct) {
  TestSim sim = folded_square();
  const PointId e = sim.add({2.0, 0.0, 0.0});
  sim.system.faces.push_back({{sim.system.points()[1].id, sim.system.points()[3].id, e}});
  EXPECT_EQ(bending_warning(sim.system),
            "forces: bending: acts on 2 of the 3 faces: the others share no edge with exactly one other, or have springs along fewer than "
            "two edges");
  sim.system.faces.clear();
  EXPECT_EQ(bending_warning(sim.system), "forces: bending: acts on faces only: this scene has none");
  sim.system.dimensions = 2;
  EXPECT_EQ(bending_warning(sim.system), "forces: bending: acts in scenes of 3 dimensions only: this one has 2");
}

}  // namespace
}  // namespace hooke
