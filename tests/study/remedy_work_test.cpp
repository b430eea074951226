// The work of a search for a remedy.
#include <gtest/gtest.h>

#include "study/hard_cases/test_network.h"
#include "study/remedy/remedy.h"

namespace hooke {
namespace {

// Hundreds of points and springs of maximum stiffness, with a tenth of the default work: what cannot be tested with it takes little of it.
TEST(Remedy, SpendsLittleOnSettingsThatAreTooSlowToBeTested) {
  TestNetwork sheet = make_sheet({.rows = 16,
                                  .columns = 16,
                                  .across = {0.06, 0.0, 0.0},
                                  .down = {0.0, -0.06, 0.0},
                                  .mass = 1e-3,
                                  .stiffness = 1e6,
                                  .diagonal_stiffness = 1e6});
  Random random(1);
  for (Vec3& x : sheet.state.position) x += random.vector(1e-4);
  Scene scene;
  scene.system = std::move(sheet.system);
  scene.state = std::move(sheet.state);
  scene.settings.integrator = find_integrator("runge_kutta4");
  scene.settings.substeps = 4;
  const Remedy remedy = find_remedy(scene, 3.0, std::atomic<bool>(false), 0.1 * default_remedy_work);
  const std::string description = describe(remedy, scene.settings);
  ASSERT_TRUE(remedy.cheapest) << description;
  EXPECT_LT(remedy.cheapest->duration, 1.0) << description;
  EXPECT_FALSE(remedy.cheapest->advice.integrator->iterates()) << description;
  ASSERT_TRUE(remedy.untested) << description;
  EXPECT_EQ(remedy.untested->advice.integrator, scene.settings.integrator) << description;
  EXPECT_GT(remedy.untested->duration, 1.0) << description;
}

}  // namespace
}  // namespace hooke
