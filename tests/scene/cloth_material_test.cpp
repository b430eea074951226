// Cloth as a material: its parameters mean the same at any number of points, and the other spring parameterizations are kept.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "edit/command.h"
#include "edit/copy_selection.h"
#include "formats/scene_file.h"
#include "lab/lab.h"
#include "scene/parameters.h"
#include "sim/methods/integrator.h"
#include "support/apply_now.h"
#include "support/parse_text.h"
#include "support/scratch_folder.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

// A square meter of n x n points, hung by its first row.
Scene sheet(int n, const std::string& members) {
  const std::string points = "[" + std::to_string(n) + ", " + std::to_string(n) + "]";
  return parse(R"({"hooke": 1, "reading": "material", "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0],
    "down": [0, -1, 0], "points": )" +
               points + R"(, "nail": ["top"], )" + members + "}]}");
}

void set(Scene& scene, const char* name, double value) {
  Effect effect;
  apply(scene, SetParameter{find_parameter(name), value}, effect);
}
double read(const Scene& scene, const char* name) { return find_parameter(name)->read(scene); }

// How a sheet hangs and how it oscillates vertically in the mode sin(pi s / 2) of a thread of its length s.
struct Swing {
  double sag = 0.0;     // [m], of the lower edge
  double period = 0.0;  // [s]
  double decay = 0.0;   // [1/s]
};
Swing measure(const Scene& scene) {
  TestSim sim{scene.system, scene.state};
  const auto n = static_cast<Index>(sim.system.points().size());
  const auto mode = [](const Vec3& place) { return std::sin(-0.5 * std::numbers::pi * place.y); };
  const std::vector<Vec3> flat = sim.state.position;
  const Integrator& verlet = *find_integrator("velocity_verlet");
  const double h = 0.7 / bound_spectrum(sim.system).omega;

  // to rest, with drag slightly above the critical damping of the mode
  const double drag = sim.system.drag;
  sim.system.drag = 50.0;
  sim.run(verlet, 0.6, static_cast<int>(0.6 / h));
  const std::vector<Vec3> rest = sim.state.position;
  Swing swing;
  int edge = 0;
  for (Index i = 0; i < n; ++i)
    if (flat[i].y == -1.0) swing.sag += flat[i].y - rest[i].y, ++edge;
  swing.sag /= edge;

  // released from there
  sim.system.drag = drag;
  for (Index i = 0; i < n; ++i) sim.state.velocity[i].y = sim.system.points()[i].nailed ? 0.0 : 0.02 * mode(flat[i]);
  constexpr double sample = 1e-3;
  double before = 0.0, top = 0.0;
  std::vector<double> crossings, tops;
  for (int s = 1; crossings.size() < 5; ++s) {
    sim.run(verlet, sample, static_cast<int>(sample / h) + 1);
    double now = 0.0;
    for (Index i = 0; i < n; ++i) now += sim.system.points()[i].mass * mode(flat[i]) * (sim.state.position[i].y - rest[i].y);
    top = std::max(top, std::abs(now));
    if (before * now < 0.0) {
      crossings.push_back(sample * (s - now / (now - before)));
      tops.push_back(std::exchange(top, 0.0));
    }
    before = now;
  }
  swing.period = 2.0 * (crossings[4] - crossings[0]) / 4.0;
  swing.decay = std::log(tops[1] / tops[4]) / (1.5 * swing.period);
  return swing;
}

// sag 1 %, period 0.3 %, decay 5 %, relative to the finest
void expect_mesh_independent(const std::string& members) {
  std::array<Swing, 4> swings;
  constexpr std::array sizes{9, 17, 33, 65};
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    Scene scene = sheet(sizes[s], members + R"("mass_model": "equal", "stiffness": 1)");
    set(scene, "sheet_stiffness", 800.0 / 3.0);
    set(scene, "sheet_damping", 0.8 / 3.0);
    set(scene, "sheet_density", 1.0);
    set(scene, "drag", 0.1);
    swings[s] = measure(scene);
  }
  const Swing& finest = swings.back();
  for (const Swing& swing : swings) {
    EXPECT_NEAR(swing.sag, finest.sag, 0.01 * finest.sag);
    EXPECT_NEAR(swing.period, finest.period, 0.003 * finest.period);
    EXPECT_NEAR(swing.decay, finest.decay, 0.05 * finest.decay);
  }
  // a thread: sag density g / (2 E t), period 4 sqrt(density / E t), decay c / 2 + eta omega^2 / (2 E t); a sheet held at the top is
  // slightly stiffer, because it cannot contract there
  const double omega = 2.0 * std::numbers::pi / finest.period;
  EXPECT_NEAR(finest.sag, 9.81 * 3.0 / 1600.0, 0.05 * finest.sag);
  EXPECT_NEAR(finest.period, 4.0 * std::sqrt(3.0 / 800.0), 0.03 * finest.period);
  EXPECT_NEAR(finest.decay, 0.05 + 0.0005 * omega * omega, 0.03 * finest.decay);
}

TEST(Sheet, BehavesTheSameAtAnyNumberOfPoints) { expect_mesh_independent(""); }

TEST(Sheet, WithoutDiagonalsBehavesTheSameToo) { expect_mesh_independent(R"("stencil": 4, )"); }

TEST(Sheet, FromAFileEqualsOneSetBySliders) {
  const Scene given = sheet(7, R"("density": 0.3, "sheet_stiffness": 900, "sheet_damping": 0.7, "stencil": 12)");
  EXPECT_NEAR(read(given, "sheet_stiffness"), 900.0, 1e-9);
  EXPECT_NEAR(read(given, "sheet_damping"), 0.7, 1e-12);
  EXPECT_NEAR(read(given, "sheet_density"), 0.3, 1e-12);
  EXPECT_EQ(given.system.springs().front().stiffness, 0.375 * 900.0);  // along the border

  // bend springs are not part of the sheet
  Scene set_by_hand = sheet(7, R"("density": 2, "sheet_stiffness": 1, "stencil": 12)");
  set(set_by_hand, "sheet_stiffness", 900.0);
  set(set_by_hand, "sheet_damping", 0.7);
  set(set_by_hand, "sheet_density", 0.3);
  for (Index s = 0; s < given.system.spring_count(); ++s) EXPECT_EQ(set_by_hand.system.springs()[s], given.system.springs()[s]);
  for (Index i = 0; i < given.system.point_count(); ++i)
    EXPECT_NEAR(set_by_hand.system.points()[i].mass, given.system.points()[i].mass, 1e-15);
}

// for any cell shape, the strip between two rows of springs carries E t times its width
TEST(Sheet, WithOblongCellsIsIsotropic) {
  const Scene scene = parse(R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [4, 0, 0], "down": [0, -3, 0],
    "points": [5, 13], "stencil": 4, "sheet_stiffness": 60}]})");
  double across = 0.0, down = 0.0;  // [N], of all springs between two columns, between two rows, by their strain
  for (const Spring& spring : scene.system.springs()) {
    const auto from = scene.state.position[scene.system.index_of(spring.first)],
               to = scene.state.position[scene.system.index_of(spring.second)];
    if (from.x == 0.0 && to.x == 1.0) across += spring.stiffness * spring.rest_length;
    if (from.y == 0.0 && to.y == -0.25) down += spring.stiffness * spring.rest_length;
  }
  EXPECT_NEAR(across, 60.0 * 3.0, 1e-9);
  EXPECT_NEAR(down, 60.0 * 4.0, 1e-9);
}

TEST(Parameterizations, DescribeTheSameSpringsWithDifferentParameters) {
  Scene scene = sheet(5, R"("stiffness": 8, "damping": 0.5, "stencil": 4, "mass_model": "equal")");  // 0.25 m each
  EXPECT_EQ(read(scene, "stiffness"), 8.0);
  EXPECT_EQ(read(scene, "stiffness_per_strain"), 2.0);
  EXPECT_EQ(read(scene, "damping_per_length"), 2.0);
  set(scene, "stiffness_per_strain", 3.0);
  set(scene, "damping_per_length", 4.0);
  for (const Spring& spring : scene.system.springs()) {
    EXPECT_EQ(spring.stiffness, 12.0);
    EXPECT_EQ(spring.damping, 1.0);
  }
}

TEST(Parameterizations, HaveTheirOwnRows) {
  Scene scene = sheet(5, R"("stiffness": 8)");
  const auto applying = [&](const char* parameterization) {
    std::string names;
    set(scene, "reading",
        std::string_view(parameterization) == "plain"        ? 0
        : std::string_view(parameterization) == "per_strain" ? 1
        : std::string_view(parameterization) == "by_size"    ? 2
                                                             : 3);
    for (const char* name : {"stiffness", "stiffness_per_strain", "structural_stiffness", "damping", "damping_per_length",
                             "sheet_stiffness", "sheet_damping", "sheet_density"}) {
      const Parameter& row = *find_parameter(name);
      if (row.applies == nullptr || row.applies(scene)) names += std::string(name) + " ";
    }
    return names;
  };
  EXPECT_EQ(applying("plain"), "stiffness structural_stiffness damping ");
  EXPECT_EQ(applying("per_strain"), "stiffness_per_strain damping ");
  EXPECT_EQ(applying("by_size"), "stiffness structural_stiffness damping_per_length ");
  EXPECT_EQ(applying("material"), "sheet_stiffness sheet_damping sheet_density ");
}

// bend springs contribute nothing to the in-plane stiffness: as a material they have their own slider, and no other affects it
TEST(Parameterizations, LeaveTheStiffnessOfBendSpringsUnchanged) {
  Scene scene = sheet(5, R"("stiffness": 8, "stencil": 12, "bend_stiffness": 3)");
  ASSERT_TRUE(find_parameter("bend_stiffness")->applies(scene));
  EXPECT_FALSE(find_parameter("shear_stiffness")->applies(scene));
  const auto before = scene.system.springs();
  set(scene, "sheet_stiffness", 100.0);
  set(scene, "sheet_damping", 2.0);
  for (Index s = 0; s < scene.system.spring_count(); ++s)
    EXPECT_EQ(scene.system.springs()[s] == before[s], before[s].family == SpringFamily::Bend);
  set(scene, "bend_stiffness", 5.0);
  EXPECT_EQ(read(scene, "bend_stiffness"), 5.0);
  EXPECT_NEAR(read(scene, "sheet_stiffness"), 100.0, 1e-12);
}

TEST(Parameterizations, AreSavedWithTheirParameters) {
  Scene scene = sheet(4, R"("stiffness": 8)");
  EXPECT_EQ(parse(format_scene(scene)).parameterization, SpringParameterization::Material);
  scene.state.position[5].z = 0.1;  // no longer as generated, so everything is listed
  const std::string text = format_scene(scene);
  ASSERT_EQ(text.find("generators"), std::string::npos);
  const Scene back = parse(text);
  EXPECT_EQ(back.parameterization, SpringParameterization::Material);
  EXPECT_EQ(back.sheet->area, scene.sheet->area);
  EXPECT_EQ(back.sheet->spring_weight, scene.sheet->spring_weight);
  EXPECT_THROW(parse(R"({"hooke": 1, "reading": "yards"})"), InputError);
}

TEST(Parameterizations, AreUndoneExactly) {
  const Scene start = sheet(6, R"("stiffness": 7.3, "damping": 0.11, "shear_stiffness": 1.9)");
  for (const char* name : {"sheet_stiffness", "sheet_damping", "sheet_density", "stiffness_per_strain", "damping_per_length", "reading"}) {
    Scene scene = start;
    Effect effect;
    const auto inverse = apply(scene, SetParameter{find_parameter(name), 2.0}, effect);
    EXPECT_TRUE(scene.system != start.system || scene.parameterization != start.parameterization) << name;
    for (const Command& command : inverse) apply(scene, command, effect);
    EXPECT_EQ(scene.system, start.system) << name;
    EXPECT_EQ(scene.parameterization, start.parameterization) << name;
  }
}

Insert insertion_into(Lab& lab, const Scene& part) {
  return make_insert(part, Vec3(0.0), {[&] { return lab.new_point_id(); }, [&] { return lab.new_spring_id(); }});
}

TEST(Sheet, InsertedIntoAnotherSceneHasItsSlidersThere) {
  const Scene part = sheet(4, R"("sheet_stiffness": 80)");
  Scene other = parse(R"({"hooke": 1, "reading": "material", "points": [{"position": [0, 1, 0], "nailed": true}]})");
  ASSERT_EQ(other.sheet, nullptr);
  Lab lab(other);
  lab.submit(insertion_into(lab, part));
  apply_now(lab);
  const auto is_there = [&](const Scene& scene) {
    ASSERT_NE(scene.sheet, nullptr);
    ASSERT_EQ(scene.system.point_count(), 17);
    for (Index i = 0; i < 16; ++i)
      EXPECT_EQ(scene.sheet->area_of(scene.system.points()[i + 1].id), part.sheet->area_of(part.system.points()[i].id));
    for (Index s = 0; s < part.system.spring_count(); ++s)
      EXPECT_EQ(scene.sheet->sheet_weight_of(scene.system.springs()[s].id), part.sheet->sheet_weight_of(part.system.springs()[s].id));
    EXPECT_EQ(scene.sheet->area_of(scene.system.points()[0].id), 0.0);
    EXPECT_TRUE(find_parameter("sheet_stiffness")->applies(scene));
    EXPECT_NEAR(read(scene, "sheet_stiffness"), 80.0, 1e-12);
  };
  is_there(lab.scene());
  lab.submit(Undo{});
  apply_now(lab);
  EXPECT_EQ(lab.scene().sheet, nullptr);
  lab.submit(Redo{});
  apply_now(lab);
  is_there(lab.scene());
  is_there(parse(format_scene(lab.scene())));

  lab.submit(SetParameter{find_parameter("sheet_stiffness"), 40.0});
  apply_now(lab);
  for (const Spring& spring : lab.scene().system.springs())
    EXPECT_EQ(spring.stiffness, 40.0 * lab.scene().sheet->sheet_weight_of(spring.id));
}

TEST(Sheet, KeepsItsMaterialWhenHalfOfItIsDeletedAndRestored) {
  const Scene start = sheet(5, R"("sheet_stiffness": 80)");
  Lab lab(start);
  Remove half;
  for (Index i = 0; i < 10; ++i) half.points.push_back(start.system.points()[i].id);
  lab.submit(half);
  apply_now(lab);
  ASSERT_NE(lab.scene().sheet, nullptr);
  EXPECT_EQ(lab.scene().sheet->area_of(half.points[0]), 0.0);
  lab.submit(Undo{});
  apply_now(lab);
  EXPECT_EQ(*lab.scene().sheet, *start.sheet);
}

TEST(Sheet, KeepsItsMaterialWhenCopiedAndInARecording) {
  const Scene start = sheet(4, R"("sheet_stiffness": 80)");
  ScratchFolder scratch;
  const auto file = std::make_shared<const std::filesystem::path>(scratch.folder / "copy.hookelog");
  Lab lab(start);
  lab.submit(Record{file});
  apply_now(lab);
  const Scene part = parse(format_scene(copy_selection(*lab.status()->snapshot, lab.status()->document->sheet, select_all(start.system))));
  lab.submit(insertion_into(lab, part));
  lab.submit(SetParameter{find_parameter("sheet_density"), 3.0});
  lab.step();
  lab.submit(Undo{});  // the recording contains the scene, with ids
  lab.step();
  lab.submit(Record{});
  apply_now(lab);
  const auto& areas = lab.scene().sheet->area;
  ASSERT_EQ(areas.size(), 32u);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(areas[16 + i], areas[i]);

  auto recording = std::make_shared<const Recording>(read_recording(*file));
  Lab again(*recording->start);
  again.submit(Play{recording});
  apply_now(again);
  while (again.is_playing()) again.step();
  EXPECT_EQ(again.difference(), "");
  EXPECT_EQ(*again.scene().sheet, *lab.scene().sheet);
}

TEST(Generators, RefuseAMaterialThatIsSpecifiedTwice) {
  const auto refusal = [](const std::string& members) -> std::string {
    try {
      sheet(4, members);
      return "";
    } catch (const InputError& refused) {
      return refused.what();
    }
  };
  EXPECT_NE(refusal(R"("sheet_stiffness": 1, "stiffness": 1)").find("sheet_stiffness or stiffness, not both"), std::string::npos);
  EXPECT_NE(refusal(R"("sheet_stiffness": 1, "mass_model": "equal")").find("tributary"), std::string::npos);
  EXPECT_NE(refusal(R"("sheet_damping": 1, "stiffness": 1)").find("must have sheet_stiffness"), std::string::npos);
  EXPECT_NE(refusal(R"("stiffness": 1, "damping": 1, "damping_per_length": 1)").find("not both"), std::string::npos);
}

}  // namespace
}  // namespace hooke
