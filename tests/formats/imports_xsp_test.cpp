// Files of XSpringies: their dynamics are preserved, and invalid files are refused with the line. In these files lengths are in pixels; one
// pixel is a centimeter.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "formats/xsp/xsp_file.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"
#include "sim/step/divergence.h"
#include "sim/step/step.h"

namespace hooke {
namespace {

constexpr double pixel = 0.01;  // [m]

std::string file_of(const std::string& lines) { return "#1.0 a file of this test\n" + lines; }

LoadedScene load(const std::string& lines) { return parse_xsp(file_of(lines), "test.xsp"); }

// Runs the scene with its own settings.
void run(Scene& scene, double seconds) {
  Plan plan = make_plan(scene.system);
  Frame frame;
  const int frames = static_cast<int>(std::lround(seconds * scene.settings.frame_rate));
  for (int i = 0; i < frames; ++i) {
    frame.begin(plan, scene.system, scene.settings, scene.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, scene.state);
  }
}

std::string refusal(const std::string& text) {
  try {
    parse_xsp(text, "test.xsp");
  } catch (const InputError& refused) {
    return refused.what();
  }
  return "not refused";
}

bool warns(const LoadedScene& loaded, const std::string& words) {
  for (const std::string& warning : loaded.warnings)
    if (warning.find(words) != std::string::npos) return true;
  return false;
}

// x'' = -(k/m) x - (d/m) x' from x = x0 at rest, 0 < d < 2 sqrt(k m).
double damped_oscillation(double x0, double k, double d, double m, double t) {
  const double decay = d / (2.0 * m), omega = std::sqrt(k / m - decay * decay);
  return x0 * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
}

TEST(Xsp, AMassOnASpringFollowsTheClosedForm) {
  const double k = 30.0, m = 2.0, seconds = 3.0;
  for (const double d : {0.0, 1.5}) {
    LoadedScene loaded = load("mass 7 100 300 0 0 -1 1\nmass 3 240 300 0 0 2 1\nspng 1 7 3 30 " + std::to_string(d) + " 100\n");
    Scene& scene = loaded.scene;
    EXPECT_TRUE(loaded.warnings.empty());
    run(scene, seconds);
    const double stretch = scene.state.position[1].x - scene.state.position[0].x - 100 * pixel;

    // the phase error of Verlet is (h omega)^2 / 24 of the angle; that of the split dashpot is not larger
    const double omega = std::sqrt(k / m), h = scene.settings.substep();
    const double tolerance = 2.0 * 40 * pixel * std::pow(h * omega, 2) / 24.0 * omega * seconds;
    EXPECT_NEAR(stretch, damped_oscillation(40 * pixel, k, d, m, seconds), tolerance) << "d = " << d;
  }
}

TEST(Xsp, TwoBodiesRotateAndPassThroughEachOtherAboutAFallingCenter) {
  const double k = 50.0, m1 = 1.0, m2 = 3.0, seconds = 2.0;
  LoadedScene loaded = load(
      "frce 0 1 20 30\n"
      "mass 1 200 400 10 5 1 1\nmass 2 320 400 10 5 3 1\nspng 1 1 2 50 0 100\n");
  Scene& scene = loaded.scene;
  run(scene, seconds);
  const Vec3 first = scene.state.position[0], second = scene.state.position[1];

  // gravity: 20 pixels/s^2, 30 degrees from vertically down towards +x
  const double angle = std::numbers::pi / 6.0;
  const Vec3 gravity = 20 * pixel * Vec3(std::sin(angle), -std::cos(angle), 0.0);
  const Vec3 start = pixel * Vec3(290, 400, 0), velocity = pixel * Vec3(10, 5, 0);
  const Vec3 center = start + seconds * velocity + 0.5 * seconds * seconds * gravity;
  EXPECT_NEAR(((m1 * first + m2 * second) / (m1 + m2)).x, center.x, 1e-12);
  EXPECT_NEAR(((m1 * first + m2 * second) / (m1 + m2)).y, center.y, 1e-12);

  const double omega = std::sqrt(k * (m1 + m2) / (m1 * m2)), h = scene.settings.substep();
  const double tolerance = 2.0 * 20 * pixel * std::pow(h * omega, 2) / 24.0 * omega * seconds;
  EXPECT_NEAR(second.x - first.x, (100 + 20 * std::cos(omega * seconds)) * pixel, tolerance);
}

TEST(Xsp, ViscosityBecomesDragAndElasticityBecomesRestitution) {
  Scene falling = load("frce 0 1 100 0\nvisc 0.5\nmass 1 50 400 0 0 4 1\n").scene;
  run(falling, 2.0);
  // v = g/c (1 - e^(-c t))
  EXPECT_NEAR(falling.state.velocity[0].y, -100 * pixel / 0.5 * (1.0 - std::exp(-0.5 * 2.0)), 1e-12);

  // with a radius of 5 pixels, from 50 pixels above the bottom of the window: reaches it after 1 s, rises to e^2 of the height within e s
  Scene bouncing = load("frce 0 1 100 0\nwall 0 0 0 1\nmass 1 50 55 0 0 4 0.5\n").scene;
  run(bouncing, 1.5);
  EXPECT_NEAR(bouncing.state.position[0].y, (5 + 0.5 * 0.5 * 50) * pixel, 1e-10);
}

// Radii of 5 pixels: the second starts, and the first stops, after 20 pixels, 1 s.
TEST(Xsp, MassesCollideIfTheFileSaysSo) {
  const std::string masses = "mass 1 100 100 20 0 4 1\nmass 2 130 100 0 0 4 1\n";
  Scene scene = load("frce 4 1 0 0\n" + masses).scene;
  run(scene, 2.0);
  EXPECT_NEAR(scene.state.position[0].x, 120 * pixel, 1e-10);
  EXPECT_NEAR(scene.state.position[1].x, 150 * pixel, 1e-10);
  EXPECT_FALSE(load("frce 4 0 0 0\n" + masses).scene.system.contact.any());
}

TEST(Xsp, APullTowardsTheCenterKeepsAMassOnItsCircle) {
  // p1 / r^2 in pixels, from the center of the window: speed sqrt(p1 / r), period 2 pi r / speed
  const double r = 100.0, p1 = 9e4, speed = std::sqrt(p1 / r), period = 2.0 * std::numbers::pi * r / speed;
  LoadedScene loaded = load("frce 2 1 9e4 2\nmass 1 421 275 0 30 5 1\n");
  EXPECT_TRUE(warns(loaded, "the center of forces is at x = 321, y = 275 pixels"));
  Scene& scene = loaded.scene;
  scene.settings.frame_rate = 100.0 / period;
  scene.settings.substeps = 50;
  run(scene, period / 4.0);
  EXPECT_NEAR(glm::distance(scene.state.position[0], pixel * Vec3(321, 375, 0)), 0.0, 1e-5);
  run(scene, 3.0 * period / 4.0);
  EXPECT_NEAR(glm::distance(scene.state.position[0], pixel * Vec3(421, 275, 0)), 0.0, 1e-5);
}

TEST(Xsp, TheCenterOfMassIsPulledTowardsAMass) {
  // X'' = -(p1 X + p2 V) / M of the free masses, M = 1 + 3
  LoadedScene loaded = load("cent 9\nfrce 1 1 40 4\nmass 1 200 100 0 0 1 1\nmass 2 240 100 0 0 3 1\nmass 9 100 100 0 0 -4 1\n");
  EXPECT_TRUE(loaded.warnings.empty());
  Scene& scene = loaded.scene;
  scene.settings.substeps = 200;
  const double M = 4.0;
  run(scene, 1.0);
  const double x0 = 130 * pixel, x = (scene.state.position[0].x + 3.0 * scene.state.position[1].x) / M - 100 * pixel;
  EXPECT_NEAR(x, damped_oscillation(x0, 40, 4, M, 1.0), 1e-4);
  EXPECT_NEAR(scene.state.position[1].x - scene.state.position[0].x, 40 * pixel, 1e-12);
}

TEST(Xsp, RepellingWallsSupplyTheEnergyOfTheirPotential) {
  // a = p1 / d of the surface from the bottom: v^2 / 2 = p1 ln(d / d0); the radius of a mass of 2 is 4 pixels
  Scene scene = load("frce 3 1 1e4 1\nwall 0 0 0 1\nmass 1 100 54 0 0 2 1\n").scene;
  run(scene, 1.0);
  const double d = scene.state.position[0].y / pixel - 4.0, v = scene.state.velocity[0].y / pixel;
  EXPECT_GT(d, 100.0);
  EXPECT_NEAR(0.5 * v * v / (1e4 * std::log(d / 50.0)), 1.0, 1e-4);
}

TEST(Xsp, AStickyWallHoldsAMassUpToItsStrength) {
  for (const auto& [stickiness, leaves] : {std::pair("20", false), std::pair("5", true)}) {
    // gravity of 10 pixels/s^2 upwards on a mass of 1 at the bottom
    Scene scene = load(std::string("frce 0 1 10 180\nwall 0 0 0 1\nmass 1 100 3 0 0 1 1\nstck ") + stickiness + "\n").scene;
    run(scene, 1.0);
    EXPECT_EQ(scene.state.position[0].y > 4 * pixel, leaves) << stickiness;
  }
}

TEST(Xsp, MassDefaultsAndEditorSettingsAreRead) {
  const LoadedScene loaded = load(
      "cmas 2.5\nelas 0.8\nkspr 7\nkdmp 0.25\nfixm 0\nshws 1\ncent -1\nfrce 0 0 10 0\nfrce 1 0 5 2\nvisc 0\nstck 0\n"
      "step 0.0001\nprec 1\nadpt 1\ngsnp 20 0\nwall 0 0 0 0\n\nmass 2 1e1 +20 -.5 0 -3 0.8\r\nmass 1 0 0 0 0 1 0.8");
  EXPECT_TRUE(loaded.warnings.empty());
  const Scene& scene = loaded.scene;
  EXPECT_EQ(scene.name, "test");
  EXPECT_EQ(scene.system.dimensions, 2);
  EXPECT_EQ(scene.system.gravity, Vec3(0.0));
  ASSERT_EQ(scene.system.point_count(), 2);
  EXPECT_TRUE(scene.system.points()[0].nailed);
  EXPECT_EQ(scene.system.points()[0].mass, 3.0);
  EXPECT_FALSE(scene.system.points()[1].nailed);
  EXPECT_EQ(scene.state.position[0], Vec3(0.1, 0.2, 0.0));
  EXPECT_EQ(scene.state.velocity[0], Vec3(-0.005, 0.0, 0.0));
  EXPECT_EQ(scene.defaults.mass, 2.5);
  EXPECT_EQ(scene.defaults.stiffness, 7.0);
  EXPECT_EQ(scene.defaults.damping, 0.25);
  EXPECT_LE(scene.settings.substep(), 0.0001);
  EXPECT_EQ(scene.settings.tolerance, 0.01);
}

TEST(Xsp, AnEmptyFileIsAScene) {
  EXPECT_EQ(load("").scene.system.point_count(), 0);
  EXPECT_EQ(parse_xsp("#1.0", "test.xsp").scene.system.point_count(), 0);
}

TEST(Xsp, StiffSpringsGetAStableStep) {
  // a chain under gravity, k/m up to 1e7: the step of the file, 0.025, would diverge at once
  for (const char* k : {"1e3", "1e5", "1e7"}) {
    std::string lines = "frce 0 1 981 0\nstep 0.025\n";
    for (int i = 0; i < 10; ++i)
      lines += "mass " + std::to_string(i + 1) + " " + std::to_string(100 + 20 * i) + " 300 0 0 " + (i == 0 ? "-1" : "1") + " 1\n";
    for (int i = 1; i < 10; ++i)
      lines += "spng " + std::to_string(i) + " " + std::to_string(i) + " " + std::to_string(i + 1) + " " + k + " 0 20\n";
    Scene scene = load(lines).scene;
    EXPECT_LT(scene.settings.substep(), largest_stable_step(*scene.settings.integrator, bound_spectrum(scene.system)));
    initialize_supply(scene.system, scene.state);
    run(scene, 1.0);
    EXPECT_FALSE(find_divergence(scene.system, scene.state, compute_energy(scene.system, scene.state))) << k;
  }
}

TEST(Xsp, WallsAreAtTheWindow) {
  const LoadedScene loaded = load("wall 1 1 1 1\nmass 1 -50 100 0 0 1 1\nmass 2 100 700 0 0 1 1\n");
  EXPECT_TRUE(warns(loaded, "x = 0 and 642, y = 0 and 550 pixels"));
  ASSERT_EQ(loaded.scene.system.colliders.size(), 4u);
  for (const Collider& collider : loaded.scene.system.colliders) {
    EXPECT_TRUE(collider.solid && collider.one_way);
    EXPECT_EQ(collider.restitution, 1.0);
    const Plane& plane = std::get<Plane>(collider.shape);
    EXPECT_NEAR(glm::dot(plane.normal, Vec3(3.21, 2.75, 0.0) - plane.point), plane.normal.x != 0.0 ? 3.21 : 2.75, 1e-12);
  }
}

TEST(Xsp, StatementsThatCannotBeConvertedGiveWarnings) {
  const std::string masses = "mass 1 10 10 0 0 1 0.5\nmass 2 20 10 0 0 1 0.5\nmass 3 30 10 0 0 1 0.9\nmass 4 40 10 0 0 -1 0.1\n";
  EXPECT_TRUE(warns(load("frce 9 1 5 2\n"), "force 9 is unknown"));
  EXPECT_TRUE(warns(load("frce 1 1 -5 2\n"), "\"Pull on center of mass\" is ignored: Stiffness would be -5"));
  EXPECT_TRUE(warns(load("frce 3 1 5 -1\n"), "\"Wall repulsion\" is ignored: Exponent would be -1"));
  EXPECT_FALSE(warns(load("frce 9 0 5 2\n"), "force"));
  EXPECT_TRUE(warns(load("wall 1 0 0 0\n" + masses), "1 mass with an elasticity other than 0.5"));
  EXPECT_TRUE(warns(load("wall 1 0 0 0\nmass 1 10 10 0 0 1 1.5\n"), "elasticity 1.5 becomes 1"));
  EXPECT_TRUE(warns(load("fixm 1\n"), "fixm"));
  EXPECT_TRUE(warns(load("shws 0\n"), "shws"));
  EXPECT_TRUE(warns(load("gsnp 20 1\n"), "gsnp"));
  EXPECT_TRUE(warns(load("kspr -1\n"), "kspr -1"));
  EXPECT_TRUE(warns(load("visc 1\nvisc 2\n"), "line 3: visc"));
  EXPECT_TRUE(warns(load("mass 1 5 5 0 0 1 1\nmass 2 5 5 0 0 1 1\nspng 1 1 2 1 0 3\n"), "1 spring connects masses at the same position"));
  EXPECT_EQ(load("visc 1\nvisc 2\n").scene.system.drag, 2.0);
}

TEST(Xsp, InvalidFilesAreRefusedWithTheLine) {
  EXPECT_EQ(refusal(""), "test.xsp: line 1: \"\": must begin with #1.0");
  EXPECT_EQ(refusal("{\"hooke\": 1}"), "test.xsp: line 1: \"{\"hooke\": 1}\": must begin with #1.0");
  EXPECT_EQ(refusal("#2.0\n"), "test.xsp: line 1: \"#2.0\": must begin with #1.0");
  EXPECT_EQ(refusal(file_of("visc\n")), "test.xsp: line 2: visc: viscosity: is missing");
  EXPECT_EQ(refusal(file_of("\nvisc 1 2\n")), "test.xsp: line 3: visc: \"2\": is a surplus value");
  EXPECT_EQ(refusal(file_of("visc nan\n")), "test.xsp: line 2: visc: viscosity: \"nan\": must be a number");
  EXPECT_EQ(refusal(file_of("visc -1\n")), "test.xsp: line 2: visc: viscosity: \"-1\": must be at least 0");
  EXPECT_EQ(refusal(file_of("step 0\n")), "test.xsp: line 2: step: step: \"0\": must be more than 0");
  EXPECT_EQ(refusal(file_of("elas 0.8\nfrce gravity true magnitude=10 direction=0\nmass 1 320 360 -1 0.8\n")),
            "test.xsp: line 3: frce gravity: is the dialect of GoSpringies: must be a file of XSpringies");
  EXPECT_EQ(refusal(file_of("mass 1 320 360 -1 0.8\n")),
            "test.xsp: line 2: mass: is the dialect of GoSpringies: must be a file of XSpringies");
  EXPECT_EQ(refusal(file_of("mass 1 0 1e400 0 0 1 1\n")), "test.xsp: line 2: mass: y: \"1e400\": must be a number");
  EXPECT_EQ(refusal(file_of("mass 1 0 0 inf 0 1 1\n")), "test.xsp: line 2: mass: vx: \"inf\": must be a number");
  EXPECT_EQ(refusal(file_of("mass 1 0 0 0 0x10 1 1\n")), "test.xsp: line 2: mass: vy: \"0x10\": must be a number");
  EXPECT_EQ(refusal(file_of("mass 0 0 0 0 0 1 1\n")), "test.xsp: line 2: mass: id: \"0\": must be a whole number from 1 to 2147483647");
  EXPECT_EQ(refusal(file_of("mass 1.5 0 0 0 0 1 1\n")), "test.xsp: line 2: mass: id: \"1.5\": must be a whole number from 1 to 2147483647");
  EXPECT_EQ(refusal(file_of("mass 3000000000 0 0 0 0 1 1\n")),
            "test.xsp: line 2: mass: id: \"3000000000\": must be a whole number from 1 to 2147483647");

  const std::string two = "mass 1 0 0 0 0 1 1\nmass 2 5 0 0 0 1 1\n";
  EXPECT_EQ(refusal(file_of(two + "mass 1 9 0 0 0 1 1\n")), "test.xsp: line 4: mass: id: 1: is already used");
  EXPECT_EQ(refusal(file_of(two + "spng 1 2 2 1 0 5\n")), "test.xsp: line 4: spng: 1: mass 2: must not be connected to itself");
  EXPECT_EQ(refusal(file_of(two + "spng 1 1 2 -1 0 5\n")), "test.xsp: line 4: spng: k: \"-1\": must be at least 0");
  EXPECT_EQ(refusal(file_of(two + "spng 1 1 2 1 -1 5\n")), "test.xsp: line 4: spng: damping: \"-1\": must be at least 0");
  EXPECT_EQ(refusal(file_of(two + "spng 1 1 2 1 0 -5\n")), "test.xsp: line 4: spng: rest length: \"-5\": must be at least 0");
  EXPECT_EQ(refusal(file_of(two + "spng 1 1 2 1 0 5\nspng 1 2 1 1 0 5\n")), "test.xsp: line 5: spng: id: 1: is already used");
  EXPECT_EQ(refusal(file_of("spng 1 1 2 1 0 5\n" + two)), "not refused");
  EXPECT_EQ(refusal(file_of(std::string("visc 1\0\n", 8))), "test.xsp: line 2: visc: viscosity: \"1\\u0000\": must be a number");
  EXPECT_EQ(refusal(file_of("visc \x1b[2J\n")), "test.xsp: line 2: visc: viscosity: \"\\u001b[2J\": must be a number");
}

TEST(Xsp, CanBeWrittenAndReadBackAsTheSameScene) {
  const LoadedScene loaded = load(
      "cmas 2\nkspr 3\nkdmp 0.5\nfrce 0 1 10 20\nvisc 0.1\nstep 0.001\nprec 1\nadpt 1\nwall 1 1 0 1\n"
      "cent 1\nfrce 1 1 3 4\nfrce 2 1 5 2\nfrce 3 1 100 1\nfrce 4 1 0 0\nstck 7\n"
      "mass 1 100.1 33.7 1.3 -7 -2 0.7\nmass 2 123.456789 99.99 0.1 0.2 3.3 0.7\nspng 1 1 2 12.5 0.75 69.3\n");
  std::vector<std::string> losses;
  const LoadedScene again = parse_xsp(format_xsp(loaded.scene, "again.xsp", losses), "again.xsp");
  EXPECT_TRUE(losses.empty()) << losses[0];
  const System &a = loaded.scene.system, &b = again.scene.system;
  EXPECT_EQ(a.points(), b.points());
  EXPECT_EQ(a.springs(), b.springs());
  EXPECT_EQ(a.colliders, b.colliders);
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_EQ(a.drag, b.drag);
  ASSERT_EQ(a.forces.size(), 4u);
  for (std::size_t i = 0; i < a.forces.size(); ++i) {
    EXPECT_EQ(a.forces[i].term, b.forces[i].term);
    for (std::size_t j = 0; j < max_force_parameters; ++j) EXPECT_DOUBLE_EQ(a.forces[i].values[j], b.forces[i].values[j]);
  }
  EXPECT_NEAR(glm::distance(a.gravity, b.gravity), 0.0, 1e-16);
  EXPECT_EQ(loaded.scene.state, again.scene.state);
  EXPECT_EQ(loaded.scene.defaults, again.scene.defaults);
  EXPECT_EQ(loaded.scene.settings, again.scene.settings);
}

// A scene about the origin with a floor is moved into the window, so that its floor is the bottom of the window.
TEST(Xsp, AWrittenSceneHasTheSameMotion) {
  Scene scene;
  scene.system.dimensions = 2;
  scene.system.gravity = Vec3(0.0, -9.8, 0.0);
  scene.system.drag = 0.3;
  scene.system.wind = Vec3(1.0, 0.0, 0.0);
  scene.system.colliders.push_back({.shape = Plane{Vec3(0.0, -1.0, 0.0), Vec3(0.0, 1.0, 0.0)}, .restitution = 0.5, .one_way = true});
  for (const Vec3 position : {Vec3(-0.5, 0.5, 0.0), Vec3(0.25, 0.5, 0.0)}) {
    scene.system.append_point({.id = scene.system.new_point_id(), .radius = 0.05});
    scene.state.position.push_back(position);
    scene.state.velocity.emplace_back(0.1, 0.2, 0.0);
  }
  scene.system.append_spring({.id = scene.system.new_spring_id(),
                              .first = scene.system.points()[0].id,
                              .second = scene.system.points()[1].id,
                              .rest_length = 0.5});

  std::vector<std::string> losses;
  Scene again = parse_xsp(format_xsp(scene, "again.xsp", losses), "again.xsp").scene;
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_EQ(losses[0], "again.xsp: .xsp cannot represent the origin: everything is moved by (3.335, 0.98) m, into the window");
  const Vec3 shift = again.state.position[0] - scene.state.position[0];
  scene.settings.substeps = again.settings.substeps = 200;
  run(scene, 1.5);
  run(again, 1.5);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(glm::distance(again.state.position[i] - shift, scene.state.position[i]), 0.0, 1e-10);
    EXPECT_NEAR(glm::distance(again.state.velocity[i], scene.state.velocity[i]), 0.0, 1e-9);
  }
}

TEST(Xsp, LossesNameLoadsAndRollers) {
  Scene scene;
  scene.system.dimensions = 2;
  scene.system.append_point({.id = scene.system.new_point_id(), .fixed_axes = 2, .load = {0.0, -1.0, 0.0}});
  scene.state.position.emplace_back(1.0, 1.0, 0.0);
  scene.state.velocity.emplace_back(0.0);
  std::vector<std::string> losses;
  format_xsp(scene, "again.xsp", losses);
  ASSERT_EQ(losses.size(), 2u);
  EXPECT_EQ(losses[0], "again.xsp: .xsp cannot represent the load of 1 point");
  EXPECT_EQ(losses[1], "again.xsp: .xsp cannot represent the fixed axes of 1 point");
}

TEST(Xsp, AWrittenCenterIsTheMiddleOfTheWindow) {
  Scene scene;
  scene.system.dimensions = 2;
  scene.system.gravity = Vec3(0.0);
  scene.system.forces.push_back({.term = find_force_term("center"), .values = {1.0, 2.0, 0.0, 0.5, 1.0, 0.01}});
  scene.system.forces.push_back({.term = find_force_term("buoyancy"), .values = {0.5}});
  std::vector<std::string> losses;
  const Scene again = parse_xsp(format_xsp(scene, "again.xsp", losses), "again.xsp").scene;
  EXPECT_EQ(losses.size(), 1u);  // the origin
  ASSERT_EQ(again.system.forces.size(), 1u);
  const ForceValues& values = again.system.forces[0].values;
  EXPECT_NEAR(values[0], 3.21, 1e-15);
  EXPECT_NEAR(values[1], 2.75, 1e-15);
  EXPECT_NEAR(values[3], 0.5, 1e-15);

  // two different centers, and wind, cannot be represented
  scene.system.forces.push_back({.term = find_force_term("mass_center"), .values = {0.0, 0.0, 0.0, 1.0, 1.0}});
  scene.system.forces.push_back({.term = find_force_term("wind"), .values = {}});
  format_xsp(scene, "again.xsp", losses);
  EXPECT_EQ(losses.size(), 1u + 3u);
}

TEST(Xsp, PropertiesThatTheFormatCannotRepresentAreReported) {
  Scene scene;
  std::vector<std::string> losses;
  EXPECT_THROW(format_xsp(scene, "a.xsp", losses), InputError);

  scene.system.dimensions = 2;
  scene.system.colliders = {{.shape = Sphere{}}, {.shape = Plane{Vec3(0.0), Vec3(0.0, 1.0, 0.0)}, .friction = 0.5}};
  scene.system.colliders[0].path.amplitude = {0.1, 0.0, 0.0};
  scene.system.colliders[1].path.belt = {1.0, 0.0, 0.0};
  for (const double x : {1.0, 2.0, 3.0}) {
    scene.system.append_point({.id = scene.system.new_point_id(), .radius = 0.03});
    scene.state.position.emplace_back(x, 1.0, 0.0);
    scene.state.velocity.emplace_back(0.0);
  }
  const auto id = [&](std::size_t i) { return scene.system.points()[i].id; };
  scene.system.append_spring({.id = scene.system.new_spring_id(), .first = id(0), .second = id(1), .break_strain = 0.1});
  scene.system.faces.push_back({{id(0), id(1), id(2)}});
  scene.system.scripted_hand = ScriptedHand{.point = id(0), .speed = 1.0, .seconds = 1.0};
  scene.system.strain_limit = 0.1;
  format_xsp(scene, "a.xsp", losses);
  EXPECT_EQ(losses, (std::vector<std::string>{
                        "a.xsp: .xsp cannot represent 1 collider",
                        "a.xsp: .xsp cannot represent the motion of 2 colliders",
                        "a.xsp: .xsp cannot represent the friction of walls",
                        "a.xsp: .xsp cannot represent slides along walls: impacts multiply the tangential velocity by the restitution",
                        "a.xsp: .xsp cannot represent the break strains of 1 spring",
                        "a.xsp: .xsp cannot represent the scripted hand",
                        "a.xsp: .xsp cannot represent the strain limit",
                        "a.xsp: .xsp cannot represent 1 face",
                    }));
}

}  // namespace
}  // namespace hooke
