// Springs with a law in files, edits, recordings and the laboratory.
#include <gtest/gtest.h>

#include "base/errors.h"
#include "base/json_text.h"
#include "edit/command.h"
#include "formats/lammps/lammps_model.h"
#include "formats/xsp/xsp_file.h"
#include "scene/parameters.h"
#include "sim/forces/energy/energy.h"
#include "sim/forces/forces.h"
#include "sim/methods/rows.h"
#include "support/command_text.h"
#include "support/measured_lab.h"
#include "support/parse_text.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

constexpr const char* points = R"({"hooke": 1, "dimensions": 2, "points": [{"position": [0, 0], "nailed": true}, {"position": [1, 0]}], )";
Scene with_spring(const std::string& members, const std::string& more = "") {
  return parse(points + (R"("springs": [{"points": [0, 1], "stiffness": 100)" + members + "}]" + more + "}"));
}
std::string error_of_spring(const std::string& members) {
  try {
    with_spring(members);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(LawFields, DoNotActWhereTheSpringIsSwitchedOff) {
  Scene scene = with_spring(R"(, "family": "structural", "rest_length": 0.5, "law": "cubic", "k3": 30)");
  const Spring spring = scene.system.springs()[0];
  EXPECT_GT(elastic_energy(scene.system, scene.state, spring), 0.0);
  scene.system.switches.families.fill(false);
  EXPECT_EQ(elastic_energy(scene.system, scene.state, spring), 0.0);
  EXPECT_EQ(scene.system.stiffness_bound_of(spring), 0.0);
  Motion motion;
  const Plan plan = make_plan(scene.system);
  pack(plan, scene.state, motion);
  Field f = motion.x, weight = motion.x;
  compute_forces(plan, 0.0, motion.x, motion.v, f);
  compute_external_forces(plan, 0.0, motion.x, motion.v, weight);
  EXPECT_EQ(f, weight);
}

TEST(LawFields, AreReadAndWritten) {
  const Scene scene = with_spring(
      R"(, "law": "cubic", "k3": 30, "muscle": {"amplitude": 0.25, "frequency": 2, "phase": 1.5}, "rest_length_rate": -0.1, "rest_length_limits": [0.5, null])",
      R"(, "muscles": false, "muscle_speed": 2, "muscle_offset": 0.75, "time": 3)");
  const SpringLaw law = scene.system.springs()[0].law.value();
  EXPECT_EQ(law.force, SpringForce::Cubic);
  EXPECT_EQ(law.k3, 30.0);
  EXPECT_EQ(law.amplitude, 0.25);
  EXPECT_EQ(law.frequency, 2.0);
  EXPECT_EQ(law.phase, 1.5);
  EXPECT_EQ(law.rate, -0.1);
  EXPECT_EQ(law.min_rest_length, 0.5);
  EXPECT_EQ(law.max_rest_length, SpringLaw{}.max_rest_length);
  EXPECT_EQ(scene.system.muscles, (MuscleClock{.on = false, .speed = 2.0, .offset = 0.75}));
  EXPECT_EQ(parse(format_scene(scene)).system, scene.system);
}

TEST(LawFields, OfPlainSpringsAreNotWritten) {
  const Scene scene = with_spring(R"(, "law": "linear")");
  EXPECT_FALSE(scene.system.springs().have_laws());
  const std::string text = format_scene(scene);
  EXPECT_EQ(text.find("law"), std::string::npos);
  EXPECT_EQ(text.find("muscle"), std::string::npos);
}

TEST(LawFields, AreRefusedOnOneLineWithTheLimit) {
  EXPECT_EQ(error_of_spring(R"(, "law": "rubber")"),
            "test.json: springs[0].law: \"rubber\": must be \"linear\", \"cable\", \"strut\" or \"cubic\"");
  EXPECT_EQ(error_of_spring(R"(, "law": "cable", "k3": 5)"), "test.json: springs[0].k3: must be 0 unless the law is \"cubic\"");
  EXPECT_EQ(error_of_spring(R"(, "law": "cubic", "k3": 5, "rest_length": 0)"),
            "test.json: springs[0].k3: must be at most 0 where the rest length is 0");
  EXPECT_EQ(error_of_spring(R"(, "muscle": {"amplitude": 2})"), "test.json: springs[0].muscle.amplitude: 2: must be from -1 to 1");
  EXPECT_EQ(error_of_spring(R"(, "rest_length_rate": 1, "rest_length_limits": [2, 3])"),
            "test.json: springs[0].rest_length_limits: must contain the rest length 1");
}

TEST(LawFields, AreRefusedByFormatsThatHaveNone) {
  const Scene scene = with_spring(R"(, "law": "cable")");
  std::vector<std::string> losses;
  EXPECT_THROW(format_xsp(scene, "a.xsp", losses), InputError);
  EXPECT_THROW(refuse_unsupported(scene, "a.lammps"), InputError);
}

TEST(LawEdits, AreUndoneAndRecorded) {
  Scene scene = with_spring(R"(, "law": "cable")");
  const Scene before = scene;
  SpringLaw law;
  law.amplitude = 0.5;
  const Command set = SetSpringLaw{{{SpringId{0}, law}}};
  const std::string text = text_of(set), name = "test";
  JsonParser parser;
  const rapidjson::Value& value = parser.parse(text);
  const Command same = read_command(JsonField(name, "command", value).members()[0]);
  EXPECT_EQ(text_of(same), text);
  Effect effect;
  const Inverse inverse = apply(scene, same, effect);
  EXPECT_EQ(scene.system.springs()[0].law, law);
  for (const Command& command : inverse) apply(scene, command, effect);
  EXPECT_EQ(scene.system, before.system);
}

TEST(MuscleSpeed, ChangesWithoutAJump) {
  Scene scene = with_spring(R"(, "muscle": {"amplitude": 0.3, "frequency": 1.7})", R"(, "time": 2.3)");
  const Spring spring = scene.system.springs()[0];
  const double length = scene.system.rest_length_of(spring, 2.3);
  find_parameter("muscle_speed")->write(scene, 3.0);
  EXPECT_NEAR(scene.system.rest_length_of(spring, 2.3), length, 1e-12);
  find_parameter("muscles")->write(scene, 0.0);
  EXPECT_NEAR(scene.system.rest_length_of(spring, 2.3), length, 1e-12);
  EXPECT_NEAR(scene.system.rest_length_of(spring, 5.0), length, 1e-12);
}

TEST(MuscleSpeed, OfNowDoesNotChangeThePhaseOfThen) {
  Lab lab(with_spring(R"(, "muscle": {"amplitude": 0.3, "frequency": 1.7})"));
  const auto muscle_time = [&] { return lab.scene().system.muscles.at(lab.scene().state.time); };
  run(lab, 30);
  lab.submit(Command(SetParameter{find_parameter("muscle_speed"), 3.0}));
  run(lab, 30);
  submit_and_apply(lab, GoToTime{0.25});
  EXPECT_NEAR(muscle_time(), lab.scene().state.time, 1e-12);
  submit_and_apply(lab, GoToTime{0.8});
  EXPECT_NEAR(muscle_time(), 0.5 + 3.0 * (lab.scene().state.time - 0.5), 1e-12);
}

TEST(Ropes, CanBeCables) {
  for (const char* rope : {R"({"type": "rope", "from": [0, 0, 0], "to": [1, 0, 0], "points": 5, "mass": 1, "stiffness": 100, "cable": 1})",
                           R"({"type": "hanging_rope", "cable": 1})"}) {
    const Scene scene = parse(std::string(R"({"hooke": 1, "generators": [)") + rope + "]}");
    for (const Spring& spring : scene.system.springs()) EXPECT_EQ(spring.law.value_or(SpringLaw{}).force, SpringForce::Cable) << rope;
    EXPECT_EQ(parse(format_scene(scene)).system, scene.system);
  }
}

// ---- the energy balance

// What the method gained, relative to the work of the muscles.
double unexplained(const Integrator& method, int substeps, const std::string& members, double* muscles = nullptr) {
  Scene scene = with_spring(members, R"(, "gravity": [0, -9.81])");
  scene.settings.integrator = &method;
  scene.settings.substeps = substeps;
  Lab lab = measured_lab(scene);
  run(lab, 60);
  const EnergyBalance balance = lab.accuracy().energy;
  if (muscles != nullptr) *muscles = balance.ledger[EnergyCause::Muscles];
  return std::abs(balance.method()) / (1.0 + std::abs(balance.ledger[EnergyCause::Muscles]));
}

TEST(EnergyOfLaws, IsExplainedByMusclesAndDashpots) {
  for (const Integrator* method : {&velocity_verlet, &blanes_moan4, &runge_kutta4, &tr_bdf2}) {
    double muscles = 0.0;
    EXPECT_LT(unexplained(*method, 60, R"(, "damping": 0.5, "muscle": {"amplitude": 0.2, "frequency": 1.3})", &muscles), 2e-3)
        << method->id;
    EXPECT_GT(std::abs(muscles), 0.1) << method->id;
    EXPECT_LT(unexplained(*method, 60, R"(, "law": "cable", "rest_length_rate": -0.3)", &muscles), 2e-3) << method->id;
    EXPECT_GT(muscles, 0.1) << method->id;
    EXPECT_LT(unexplained(*method, 60, R"(, "law": "cable", "damping": 0.5)"), 5e-3) << method->id;
    EXPECT_LT(unexplained(*method, 60, R"(, "law": "cubic", "k3": 300)"), 2e-3) << method->id;
  }
}

TEST(EnergyOfLaws, OfACableThatBreaksIsLost) {
  Scene scene = with_spring(R"(, "law": "cable", "break_strain": 0.15)", R"(, "gravity": [0, -9.81])");
  scene.settings.substeps = 100;
  Lab lab = measured_lab(scene);
  run(lab, 90);
  const EnergyBalance balance = lab.accuracy().energy;
  EXPECT_EQ(lab.scene().system.spring_count(), 0);
  EXPECT_LT(balance.ledger[EnergyCause::Breaks], -0.5 * 100.0 * 0.15 * 0.15);
  EXPECT_NEAR(balance.method(), 0.0, 1e-2);
}

// The automatic method keeps its tolerance on a scene with every law.
TEST(EnergyOfLaws, TheAutomaticMethodStepsThem) {
  Scene scene = parse(R"({"hooke": 1, "dimensions": 2, "points": [{"position": [0, 0], "nailed": true}, {"position": [1, 0]},
    {"position": [1.5, 0.5]}, {"position": [2, 0]}], "springs": [{"points": [0, 1], "stiffness": 300, "law": "cable"},
    {"points": [1, 2], "stiffness": 200, "law": "cubic", "k3": 900}, {"points": [2, 3], "stiffness": 200, "damping": 1, "muscle": {"amplitude": 0.2}},
    {"points": [1, 3], "stiffness": 300, "law": "strut"}], "simulation": {"integrator": "auto", "tolerance": 1e-4}})");
  Lab lab(scene, KeepStart::No);
  run(lab, 60);
  ASSERT_TRUE(lab.scene().state.memory.choice.has_value());
  EXPECT_LT(lab.scene().state.memory.choice->error.value_or(0.0), 1e-4 / 60.0);
}

}  // namespace
}  // namespace hooke
