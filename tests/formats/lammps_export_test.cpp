// Which scenes can be written for LAMMPS.
#include <gtest/gtest.h>

#include "formats/lammps/lammps_model.h"
#include "formats/open_file.h"
#include "support/contents.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

Scene two_points(const std::string& members) {
  return parse_scene(R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0], "nailed": true}], )" + members + "}",
                     "scene.json")
      .scene;
}

std::string with_spring(const std::string& members) { return R"("springs": [{"points": [0, 1], "stiffness": 30)" + members + "}]"; }

// It can be represented without `members`.
std::string elastic_plane(const std::string& members) {
  return R"("colliders": [{"type": "plane", "point": [0, -3, 0], "normal": [0, 1, 0], "restitution": 1, "friction": 0)" + members + "}]";
}

// The message, also of `convert`, which writes nothing.
void expect_refused(const Scene& scene, const std::string& message) {
  EXPECT_EQ(unsupported_by_lammps(scene), std::vector{message});
  const ScratchFolder scratch;
  const std::filesystem::path file = scratch.folder / "scene.lmp";
  try {
    write_scene_as(scene, file);
    ADD_FAILURE() << message;
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), file.string() + ": LAMMPS cannot represent " + message);
  }
  EXPECT_TRUE(std::filesystem::is_empty(scratch.folder));
}

struct RefusedByLammps {
  std::string members, message;
};

TEST(LammpsExport, NamesWhatLammpsCannotRepresent) {
  for (const RefusedByLammps& refused : {
           RefusedByLammps{with_spring(R"(, "damping": 1)"), "dashpots"},
           {with_spring(R"(, "break_strain": 0.5)"), "springs that break"},
           {with_spring("") + R"(, "strain_limit_percent": 10)", "the strain limit"},
           {with_spring("") + R"(, "forces": [{"type": "center"}])", "the force center"},
           {with_spring("") + R"(, "contact": {"points": true})", "contact between points"},
           {with_spring("") + R"(, "contact": {"faces": true})", "contact of faces and springs"},
           {R"("colliders": [{"type": "sphere", "center": [0, -3, 0], "radius": 1}])", "a sphere (colliders[0])"},
           {R"("colliders": [{"type": "box", "min": [0, -3, 0], "max": [1, -2, 1]}])", "a box (colliders[0])"},
           {R"("colliders": [{"type": "plane", "point": [0, -3, 0], "normal": [1, 1, 0], "restitution": 1, "friction": 0}])",
            "a plane that is not perpendicular to an axis (colliders[0])"},
           {R"("colliders": [{"type": "plane", "point": [0, -3, 0], "normal": [0, 1, 0], "restitution": 0.5, "friction": 0}])",
            "a plane with restitution 0.5 instead of 1 (colliders[0])"},
           {R"("colliders": [{"type": "plane", "point": [0, -3, 0], "normal": [0, 1, 0], "restitution": 1, "friction": 0.3}])",
            "a plane with friction 0.3 instead of 0 (colliders[0])"},
           {with_spring("") + R"(, "contact": {"springs": true})", "contact of faces and springs"},
           {with_spring("") + R"(, "hand": {"point": 0, "circle": {"from": [0, 0, 0], "center": [-1, 0, 0]}, "speed": 5, "seconds": 1})",
            "the scripted hand"},
           {elastic_plane(R"(, "oscillate": [0, 0.1, 0])"), "a moving plane (colliders[0])"},
           {elastic_plane(R"(, "spin": [0, 1, 0])"), "a moving plane (colliders[0])"},
           {elastic_plane(R"(, "belt": [1, 0, 0])"), "a moving plane (colliders[0])"},
           {elastic_plane("") + R"(, "generators": [{"type": "cloth", "corner": [0, 1, 0], "across": [1, 0, 0], "down": [0, 0, 1],
                                                     "points": [2, 2], "density": 0.2, "stiffness": 30, "damping": 0, "point_radius": 0.3}])",
            "a plane and points of different radii (colliders[0])"},
           {R"("colliders": [{"type": "plane", "point": [0, 0.5, 0], "normal": [0, 1, 0], "restitution": 1, "friction": 0}])",
            "a plane that point 0 starts within (colliders[0])"},
       })
    expect_refused(two_points(refused.members), refused.message);
}

TEST(LammpsExport, LimitsOfSpringsAreNoObstacleWithoutSprings) {
  EXPECT_TRUE(unsupported_by_lammps(two_points(R"("break_strain": 0.5, "strain_limit_percent": 10)")).empty());
  EXPECT_EQ(unsupported_by_lammps(two_points(with_spring("") + R"(, "break_strain": 0.5)")),
            std::vector<std::string>{"springs that break"});
}

TEST(LammpsExport, RefusesFileNamesThatLammpsCannotRead) {
  const Scene scene = two_points(with_spring(""));
  const ScratchFolder scratch;
  for (const char* name : {"a b.lmp", "\xc3\xa9.lmp", "a#1.lmp", "a*.lmp", "a%.lmp", "a$b.lmp", "a\"b.lmp"})
    EXPECT_THROW(write_scene_as(scene, scratch.folder / name), InputError) << name;
  EXPECT_NO_THROW(write_scene_as(scene, scratch.folder / "Net-1_a+b.2.lmp"));
}

TEST(LammpsExport, NamesTheHandOfTheUser) {
  Scene scene = two_points(with_spring(""));
  EXPECT_TRUE(unsupported_by_lammps(scene).empty());
  scene.system.grab = Grab{.point = scene.system.points().front().id};
  expect_refused(scene, "the hand");
  scene.system.grab.reset();
  scene.state.hand.collider.emplace();
  expect_refused(scene, "the hand");
}

TEST(LammpsExport, NamesLoadsAndRollers) {
  Scene scene = two_points(with_spring(""));
  scene.system.point(0).load = Vec3(0.0, -1.0, 0.0);
  expect_refused(scene, "loads of points");
  scene.system.point(0) = {.id = scene.system.points()[0].id, .fixed_axes = 1};
  expect_refused(scene, "points on rollers");
}

TEST(LammpsExport, NamesAllReasons) {
  const Scene scene = two_points(with_spring(R"(, "damping": 1)") + R"(, "contact": {"points": true, "faces": true}, )" +
                                 elastic_plane(R"(, "belt": [1, 0, 0])"));
  EXPECT_EQ(unsupported_by_lammps(scene), (std::vector<std::string>{"dashpots", "contact between points", "contact of faces and springs",
                                                                    "a moving plane (colliders[0])"}));
}

TEST(LammpsExport, AcceptsAPlaneThatReflects) { EXPECT_TRUE(unsupported_by_lammps(two_points(elastic_plane(""))).empty()); }

TEST(LammpsExport, WritesTheScriptAndTheDataFile) {
  const ScratchFolder scratch;
  const Scene scene =
      two_points(with_spring(R"(, "rest_length": 0.5)") + R"(, "gravity": [0, -2, 0], "simulation": {"integrator": "xpbd"})");
  const std::vector<std::string> losses = write_scene_as(scene, scratch.folder / "net.lmp");
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_NE(losses[0].find("LAMMPS runs velocity_verlet with the same step, not xpbd"), std::string::npos);
  const std::string script = contents(scratch.folder / "net.lmp"), data = contents(scratch.folder / "net.data");
  EXPECT_NE(script.find("read_data \"net.data\"\n"), std::string::npos);
  EXPECT_NE(script.find("fix gravity free gravity 2 vector 0 -2 0\n"), std::string::npos);
  EXPECT_NE(data.find("2 atoms\n1 bonds\n"), std::string::npos);
  // half the stiffness, as LAMMPS defines it; the second point is nailed
  EXPECT_NE(data.find("Bond Coeffs # harmonic\n\n1 15 0.5\n"), std::string::npos);
  EXPECT_NE(data.find("2 1 2 1 0 0\n"), std::string::npos);
}

}  // namespace
}  // namespace hooke
