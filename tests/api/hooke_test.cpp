// The interface for programs in C++, against the laboratory itself.
#include "api/hooke.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "api/hooke_c.h"
#include "formats/open_file.h"
#include "lab/lab.h"
#include "sim/model/hash.h"

namespace hooke {
namespace {

TEST(Interface, HasTheBitsOfTheLaboratory) {
  v1::Scene scene = v1::Scene::load("cloth");
  v1::Simulation simulation(scene);
  Lab lab(load_file(find_scene("cloth")).scene, KeepStart::No);
  for (int frame = 0; frame < 5; ++frame) {
    EXPECT_TRUE(simulation.step());
    lab.step();
  }
  EXPECT_EQ(simulation.hash(), hash_state(lab.scene().state));
  EXPECT_EQ(simulation.energy().total(), compute_energy(lab.scene().system, lab.scene().state).total());
  ASSERT_EQ(simulation.positions().size(), 3 * lab.scene().state.position.size());
  EXPECT_EQ(simulation.positions()[4], lab.scene().state.position[1].y);
}

TEST(Interface, BuildsAScene) {
  v1::Scene scene;
  EXPECT_EQ(scene.add_point({0, 0, 0}, 1.0, true), 0);
  EXPECT_EQ(scene.add_point({0, -1, 0}, 2.0), 1);
  EXPECT_EQ(scene.add_spring(0, 1, 100.0), 0);
  scene.add(R"("colliders": [{"type": "plane", "point": [0, -9, 0], "normal": [0, 1, 0]}])");
  scene.set_substeps(400);
  v1::Simulation simulation(scene);
  for (int frame = 0; frame < 30; ++frame) simulation.step();
  // m x'' = m g - k x from rest: x = m g / k (1 - cos(omega t))
  EXPECT_NEAR(simulation.positions()[4], -1 - 2 * 9.81 / 100 * (1 - std::cos(std::sqrt(50.0) * simulation.time())), 1e-5);
  EXPECT_EQ(v1::Scene::parse(scene.json()).json(), scene.json());
}

TEST(Interface, NamesThePointsThatTouch) {
  v1::Scene scene;
  scene.add_point({0, 0.02, 0}, 2.0);
  scene.add_point({0, 9, 0}, 1.0);
  scene.add(R"("colliders": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0]}])");
  v1::Simulation simulation(scene);
  EXPECT_TRUE(simulation.contacts().empty());
  simulation.step();
  EXPECT_EQ(simulation.contacts(), std::vector<std::int64_t>{0});
  EXPECT_NEAR(simulation.contact_forces()[1], 2 * 9.81, 1e-9);
}

TEST(Interface, ReportsErrorsInOneLine) {
  const auto kind_of = [](auto work) {
    try {
      work();
    } catch (const v1::Error& error) {
      EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos);
      return static_cast<int>(error.kind());
    }
    return -1;
  };
  using enum v1::Error::Kind;
  v1::Scene scene = v1::Scene::load("two_masses");
  v1::Simulation simulation(scene);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(kind_of([] { v1::Scene::load("nowhere"); }), static_cast<int>(File));
  EXPECT_EQ(kind_of([] { v1::Scene::parse("{}"); }), static_cast<int>(Input));
  EXPECT_EQ(kind_of([&] { scene.set("stiffness=-1"); }), static_cast<int>(Usage));
  EXPECT_EQ(kind_of([&] { scene.set_substeps(0); }), static_cast<int>(Usage));
  EXPECT_EQ(kind_of([&] { scene.set_integrator("euler"); }), static_cast<int>(Usage));
  EXPECT_EQ(kind_of([&] { scene.add_point({nan, 0, 0}, 1); }), static_cast<int>(Input));
  EXPECT_EQ(kind_of([&] { scene.add_spring(0, 0, 1); }), static_cast<int>(Input));
  EXPECT_EQ(kind_of([&] { simulation.grab(99, {}); }), static_cast<int>(Input));
  EXPECT_EQ(kind_of([&] { simulation.set("nothing=1"); }), static_cast<int>(Usage));
}

TEST(Interface, ErrorsNameTheArgumentAndNotAnOption) {
  v1::Scene scene;
  const auto refusal = [](auto work) -> std::string {
    try {
      work();
    } catch (const v1::Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal([&] { scene.set_substeps(0); }), "substeps: 0: must be from 1 to 1000000");
  EXPECT_EQ(refusal([&] { scene.set_frame_rate(-1); }), "frame_rate: -1: must be more than 0");
  EXPECT_EQ(refusal([&] { scene.set("drag=-1"); }), "set: drag=-1: must be at least 0 [1/s]");
  EXPECT_EQ(refusal([&] { scene.set_integrator("verlet"); }).find("integrator: verlet: must be one of explicit_euler, "), 0u);
}

TEST(Interface, CommandsTakeEffectAndAreUndone) {
  v1::Simulation simulation(v1::Scene::load("two_masses"));
  simulation.set("stiffness=321");
  const std::string changed = simulation.scene().json();
  simulation.undo();
  const std::string before = simulation.scene().json();
  EXPECT_NE(before, changed);
  simulation.redo();
  EXPECT_EQ(simulation.scene().json(), changed);

  simulation.grab(1, {0.1, 0.2, 0});
  simulation.step();
  EXPECT_DOUBLE_EQ(simulation.positions()[3], 0.1);
  EXPECT_DOUBLE_EQ(simulation.positions()[4], 0.2);
  simulation.release();
}

TEST(Interface, EstimatesTheErrorOnRequest) {
  v1::Simulation measured(v1::Scene::load("two_masses"), v1::Simulation::Accuracy::Full), plain(v1::Scene::load("two_masses"));
  for (int frame = 0; frame < 60; ++frame) {
    measured.step();
    plain.step();
  }
  EXPECT_GT(measured.error(), 0.0);
  EXPECT_TRUE(std::isnan(plain.error()));
  EXPECT_EQ(measured.hash(), plain.hash());
}

TEST(Interface, ADivergenceKeepsTheLastValidState) {
  v1::Scene scene = v1::Scene::load("two_masses");
  scene.set_integrator("explicit_euler");
  scene.set_substeps(1);
  scene.set_frame_rate(2);
  v1::Simulation simulation(scene);
  int frames = 0;
  while (simulation.step() && frames < 1000) ++frames;
  EXPECT_LT(frames, 1000);
  EXPECT_FALSE(simulation.diagnosis().empty());
  for (const double component : simulation.positions()) EXPECT_TRUE(std::isfinite(component));
}

TEST(Interface, AddsEveryMemberThatASceneFileHasAndRefusesOthers) {
  v1::Scene scene;
  scene.add_point({0, 1, 0}, 1.0);
  scene.add(R"("gravity": [0, -2, 0], "drag": 0.5, "simulation": {"substeps": 7}, "contact": {"points": true})");
  scene.add(R"("forces": [{"type": "wind", "x": 2}])");
  const Scene read = parse_scene(scene.json(), "scene").scene;
  EXPECT_EQ(read.system.gravity, Vec3(0.0, -2.0, 0.0));
  EXPECT_EQ(read.system.drag, 0.5);
  EXPECT_EQ(read.settings.substeps, 7);
  EXPECT_EQ(read.settings.frame_rate, 60.0);
  EXPECT_TRUE(read.system.contact.points);
  EXPECT_EQ(read.system.forces.size(), 1u);
  // what a later addition leaves out stays
  scene.add(R"("simulation": {"frame_rate": 30})");
  EXPECT_EQ(parse_scene(scene.json(), "scene").scene.settings.substeps, 7);
  const auto refusal = [&](const char* members) {
    try {
      scene.add(members);
    } catch (const v1::Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(R"("gravty": [0, -2, 0])"), "scene: gravty: unknown key");
  EXPECT_EQ(refusal(R"("simulation": {"substep": 3})"), "scene: simulation.substep: unknown key");
  EXPECT_EQ(refusal(R"("view": {})"), "scene: view: cannot be added to a scene");
}

TEST(Interface, ShowsTheNetworkAndItsForces) {
  v1::Scene scene;
  scene.add_point({0, 0, 0}, 1.0, true);
  scene.add_point({0, -1, 0}, 2.0);
  scene.add_spring(0, 1, 100.0);
  scene.add(R"("colliders": [{"type": "sphere", "center": [5, 0, 0], "radius": 0.5}])");
  v1::Simulation simulation(scene);
  simulation.move(1, {0, -1.25, 0});
  EXPECT_EQ(simulation.point_count(), 2);
  EXPECT_EQ(simulation.springs(), (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(simulation.masses(), (std::vector{1.0, 2.0}));
  EXPECT_EQ(simulation.nailed(), (std::vector{true, false}));
  EXPECT_EQ(simulation.stiffness(), std::vector{100.0});
  EXPECT_EQ(simulation.rest_lengths(), std::vector{1.0});
  EXPECT_TRUE(simulation.faces().empty());
  EXPECT_EQ(simulation.tensions(), std::vector{25.0});
  // the nail bears the spring, and the weight of its own point
  EXPECT_NEAR(simulation.reactions()[1], 25.0 + 9.81, 1e-12);
  EXPECT_EQ(simulation.reactions()[4], 0.0);
  ASSERT_EQ(simulation.colliders().size(), 1u);
  EXPECT_EQ(simulation.colliders()[0].kind, v1::Collider::Kind::Sphere);
  EXPECT_EQ(simulation.colliders()[0].first.x, 5.0);
  EXPECT_EQ(simulation.colliders()[0].radius, 0.5);
}

// The partner of the point in the second of frames in which it is pressed against the rest of the scene.
v1::Partner partner_of(std::int64_t point, const std::string& members, int frames = 60) {
  v1::Scene scene = v1::Scene::parse("{\"hooke\": 1, " + members + "}");
  v1::Simulation simulation(scene);
  for (int frame = 0; frame < frames; ++frame) simulation.step();
  const std::vector<std::int64_t> contacts = simulation.contacts();
  const std::vector<v1::Partner> partners = simulation.contact_partners();
  EXPECT_EQ(partners.size(), contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (contacts[i] == point) return partners[i];
  ADD_FAILURE() << "nothing touches point " << point;
  return {};
}

TEST(Interface, NamesWhatAPointTouchesAndTheNormalThere) {
  using Kind = v1::Partner::Kind;
  const auto expect = [](const v1::Partner& partner, Kind kind, std::int64_t number, const v1::Vector& normal) {
    EXPECT_EQ(partner.kind, kind);
    EXPECT_EQ(partner.number, number);
    for (const auto& [have, want] : {std::pair{partner.normal.x, normal.x}, {partner.normal.y, normal.y}, {partner.normal.z, normal.z}})
      EXPECT_NEAR(have, want, 1e-3) << number;
  };
  const std::string ball = R"({"position": [0, 0.1, 0], "radius": 0.1})";
  const std::string floors = R"("colliders": [{"type": "sphere", "center": [9, 0, 0], "radius": 1},
    {"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "friction": 0.5}])";
  expect(partner_of(0, "\"points\": [" + ball + "], " + floors), Kind::Collider, 1, {0, 1, 0});

  // a ball that lies on a nailed one and not on the floor
  const std::string above = R"({"position": [0, 0.31, 0], "radius": 0.1})",
                    nailed = R"(, {"position": [0, 0.1, 0], "radius": 0.1, "nailed": true})";
  expect(partner_of(0, "\"points\": [" + above + nailed + "], \"contact\": {\"points\": true}, " + floors), Kind::Point, 1, {0, 1, 0});

  // on the second of two faces, and on the second of two springs
  const std::string square = R"("points": [{"position": [-1, 0, -1], "nailed": true}, {"position": [1, 0, -1], "nailed": true},
    {"position": [1, 0, 1], "nailed": true}, {"position": [-1, 0, 1], "nailed": true}, {"position": [-0.3, 0.12, 0.3], "radius": 0.1}])";
  expect(partner_of(4, square + R"(, "faces": [[0, 1, 2], [0, 2, 3]], "contact": {"faces": true})", 30), Kind::Face, 1, {0, 1, 0});
  const std::string rope = R"("points": [{"position": [-1, 0, 0], "nailed": true}, {"position": [0, 0, 0], "nailed": true},
    {"position": [1, 0, 0], "nailed": true}, {"position": [0.5, 0.12, 0], "radius": 0.1}])";
  expect(
      partner_of(
          3,
          rope + R"(, "springs": [{"points": [0, 1], "stiffness": 10}, {"points": [1, 2], "stiffness": 10}], "contact": {"springs": true})",
          30),
      Kind::Spring, 1, {0, 1, 0});
}

TEST(Interface, StepsForATimeOnSeveralThreads) {
  const v1::Scene scene = v1::Scene::load("cloth");
  v1::Simulation frames(scene), seconds(scene);
  seconds.set_threads(2);
  for (int frame = 0; frame < 6; ++frame) frames.step();
  EXPECT_TRUE(seconds.step(0.1));
  EXPECT_EQ(seconds.hash(), frames.hash());
  EXPECT_THROW(seconds.step(-1.0), v1::Error);
  EXPECT_THROW(seconds.set_threads(0), v1::Error);
}

TEST(Interface, WhatWasMovedFromThrows) {
  v1::Scene scene;
  v1::Scene other = std::move(scene);
  EXPECT_THROW(scene.point_count(), v1::Error);
  EXPECT_THROW(v1::Scene copy(scene), v1::Error);
  v1::Simulation simulation(other);
  v1::Simulation moved = std::move(simulation);
  EXPECT_THROW(simulation.step(), v1::Error);
  EXPECT_THROW(simulation.positions(), v1::Error);
  scene = other;
  EXPECT_EQ(scene.point_count(), 0);
}

TEST(InterfaceForC, HasTheBitsOfTheInterfaceForCpp) {
  v1::Simulation expected(v1::Scene::load("cloth"));
  expected.step(0.1);
  hooke_scene* scene = hooke_scene_load("cloth");
  hooke_simulation* simulation = hooke_simulation_new(scene, HOOKE_ACCURACY_OFF);
  hooke_scene_free(scene);
  EXPECT_EQ(hooke_simulation_step(simulation, 0.1), 1);
  EXPECT_EQ(hooke_simulation_hash(simulation), expected.hash());
  EXPECT_EQ(hooke_simulation_positions(simulation)[4], expected.positions()[4]);
  std::vector<double> tensions(static_cast<std::size_t>(hooke_simulation_spring_count(simulation)));
  EXPECT_EQ(hooke_simulation_tensions(simulation, tensions.data()), 0);
  EXPECT_EQ(tensions, expected.tensions());
  hooke_simulation_free(simulation);
}

TEST(InterfaceForC, ReadsTheNetworkAsThatForCpp) {
  v1::Simulation expected(v1::Scene::load("marbles"));
  hooke_scene* scene = hooke_scene_load("marbles");
  hooke_simulation* simulation = hooke_simulation_new(scene, HOOKE_ACCURACY_OFF);
  EXPECT_EQ(hooke_scene_point_count(scene), expected.point_count());
  EXPECT_EQ(hooke_scene_json(scene), v1::Scene::load("marbles").json());
  expected.step(1.0);
  EXPECT_EQ(hooke_simulation_step(simulation, 1.0), 1);
  const auto points = static_cast<std::size_t>(expected.point_count());
  std::vector<double> masses(points), radii(points), normals(3 * points);
  std::vector<int> nailed(points), kinds(points);
  std::vector<std::int64_t> touching(points), numbers(points);
  EXPECT_EQ(hooke_simulation_masses(simulation, masses.data()), 0);
  EXPECT_EQ(masses, expected.masses());
  EXPECT_EQ(hooke_simulation_radii(simulation, radii.data()), 0);
  EXPECT_EQ(radii, expected.radii());
  EXPECT_EQ(hooke_simulation_nailed(simulation, nailed.data()), 0);
  EXPECT_EQ(std::vector<bool>(nailed.begin(), nailed.end()), expected.nailed());

  const std::vector<v1::Partner> partners = expected.contact_partners();
  ASSERT_FALSE(partners.empty());
  ASSERT_EQ(hooke_simulation_contacts(simulation, touching.data(), kinds.data(), numbers.data(), normals.data()),
            static_cast<std::int64_t>(partners.size()));
  for (std::size_t i = 0; i < partners.size(); ++i) {
    EXPECT_EQ(touching[i], expected.contacts()[i]);
    EXPECT_EQ(kinds[i], static_cast<int>(partners[i].kind));
    EXPECT_NE(partners[i].kind, v1::Partner::Kind::Unknown);
    EXPECT_EQ(numbers[i], partners[i].number);
    EXPECT_EQ(normals[3 * i + 1], partners[i].normal.y);
  }

  std::vector<hooke_collider> colliders(static_cast<std::size_t>(hooke_simulation_collider_count(simulation)));
  ASSERT_EQ(colliders.size(), expected.colliders().size());
  EXPECT_EQ(hooke_simulation_colliders(simulation, colliders.data()), 0);
  EXPECT_EQ(colliders[0].kind, static_cast<int>(expected.colliders()[0].kind));
  EXPECT_EQ(colliders[0].second[1], expected.colliders()[0].second.y);
  hooke_simulation_free(simulation);
  hooke_scene_free(scene);
}

TEST(InterfaceForC, MovesAndUndoes) {
  hooke_scene* scene = hooke_scene_load("two_masses");
  hooke_simulation* simulation = hooke_simulation_new(scene, HOOKE_ACCURACY_OFF);
  hooke_scene_free(scene);
  const std::uint64_t before = hooke_simulation_hash(simulation);
  const double to[] = {1.0, 2.0, 0.0}, at_rest[] = {0.0, 0.0, 0.0};
  EXPECT_EQ(hooke_simulation_move(simulation, 1, to, at_rest), 0);
  EXPECT_EQ(hooke_simulation_positions(simulation)[4], 2.0);
  hooke_scene* copy = hooke_simulation_scene(simulation);
  EXPECT_NE(std::string(hooke_scene_json(copy)).find("[1, 2"), std::string::npos) << hooke_scene_json(copy);
  hooke_scene_free(copy);
  EXPECT_EQ(hooke_simulation_undo(simulation), 0);
  EXPECT_EQ(hooke_simulation_hash(simulation), before);
  EXPECT_EQ(hooke_simulation_redo(simulation), 0);
  EXPECT_EQ(hooke_simulation_pull(simulation, 1, to, 50.0), 0);
  EXPECT_EQ(hooke_simulation_pull(simulation, 1, to, -1.0), -1);
  EXPECT_EQ(hooke_error_code(), 3);
  hooke_simulation_free(simulation);
}

TEST(InterfaceForC, AnswersMistakesWithALine) {
  EXPECT_EQ(hooke_scene_load("nowhere"), nullptr);
  EXPECT_EQ(std::string(hooke_error()).substr(0, 9), "nowhere: ");
  EXPECT_EQ(hooke_error_code(), 5);
  EXPECT_EQ(hooke_simulation_new(nullptr, 0), nullptr);
  EXPECT_STREQ(hooke_error(), "pointer: must not be null");
  EXPECT_EQ(hooke_error_code(), 2);
  hooke_scene* scene = hooke_scene_new();
  EXPECT_EQ(hooke_scene_set(scene, "stiffness=-1"), -1);
  EXPECT_EQ(hooke_scene_add_spring(scene, 0, 1, 1.0, 0.0), -1);
  EXPECT_EQ(hooke_scene_add(scene, nullptr), -1);
  EXPECT_EQ(hooke_simulation_diagnosis(nullptr), nullptr);
  hooke_scene_free(scene);
}

}  // namespace
}  // namespace hooke
