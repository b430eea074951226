// The shipped scenes: they load, contain what their descriptions claim, and run.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>
#include <set>

#include "formats/scene_file.h"
#include "lab/lab.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"
#include "support/contents.h"
#include "support/crossings.h"

namespace hooke {
namespace {

Scene shipped(const std::string& id) { return load_scene(find_scene(id)).scene; }

TEST(ShippedScenes, LoadWithoutWarningsExceptTheUnstableOne) {
  for (const ShippedScene& scene : shipped_scenes()) {
    const LoadedScene loaded = load_scene(scene.file);
    EXPECT_EQ(loaded.scene.name, scene.title);
    EXPECT_FALSE(loaded.scene.description.empty()) << scene.id;
    EXPECT_EQ(loaded.warnings.size(), scene.id == "unstable" ? 1u : 0u)
        << scene.id << ": " << (loaded.warnings.empty() ? "" : loaded.warnings.front());
  }
}

TEST(ShippedScenes, AreReadBackUnchangedAfterSaving) {
  for (const ShippedScene& scene : shipped_scenes()) {
    const Scene first = shipped(scene.id);
    const std::string text = format_scene(first);
    const Scene again = parse_scene(text, "again").scene;
    EXPECT_TRUE(again.system == first.system) << scene.id;
    EXPECT_TRUE(again.state == first.state) << scene.id;
    EXPECT_EQ(format_scene(again), text) << scene.id;
    EXPECT_EQ(text.find("\"generators\"") == std::string::npos, first.preserved_json.generators.empty()) << scene.id;
  }
}

TEST(ShippedScenes, TheListNamesEveryFileAndNoOther) {
  std::set<std::filesystem::path> listed, there;
  for (const ShippedScene& scene : shipped_scenes()) listed.insert(scene.file.filename());
  for (const auto& entry : std::filesystem::directory_iterator(shipped_scenes().front().file.parent_path()))
    if (entry.is_regular_file()) there.insert(entry.path().filename());
  EXPECT_EQ(listed, there);
}

// As its description says; the count shares no code with the contact.
TEST(ShippedScenes, TheTowelPassesThroughItselfOnlyWithoutContact) {
  for (const bool touches : {true, false}) {
    Scene scene = shipped("towel");
    scene.system.contact.faces = touches;
    const CrossingCounter counter(scene.system);
    Lab lab(std::move(scene));
    long worst = 0;
    for (int frame = 1; frame <= 60; ++frame) {
      ASSERT_TRUE(lab.step());
      if (frame % 3 == 0) worst = std::max(worst, counter.count(lab.scene().state.position));
    }
    EXPECT_EQ(worst == 0, touches) << worst;
  }
}

class FoldsAndStacks : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Shipped, FoldsAndStacks, testing::Values("stacked_jelly", "folded_napkin"));
INSTANTIATE_TEST_SUITE_P(Nightly, FoldsAndStacks, testing::Values("gathered_curtain"));

// The count is made every tenth of a second, for HOOKE_SECONDS seconds.
TEST_P(FoldsAndStacks, LetNothingPassThrough) {
  const char* seconds = std::getenv("HOOKE_SECONDS");
  const Scene scene = shipped(GetParam());
  const CrossingCounter counter(scene.system);
  Lab lab(scene);
  for (int frame = 1; frame <= (seconds != nullptr ? 60 * std::atoi(seconds) : 60); ++frame) {
    ASSERT_TRUE(lab.step());
    if (frame % 6 == 0) {
      ASSERT_EQ(counter.count(lab.scene().state.position), 0) << "frame " << frame;
    }
  }
}

TEST(ShippedScenes, TheReefKnotHoldsByItsFriction) {
  for (const bool rubs : {true, false}) {
    Scene scene = shipped("reef_knot");
    if (!rubs) scene.system.contact.friction = 0.0;
    const auto& points = scene.system.points();
    const auto weight = static_cast<std::size_t>(std::ranges::max_element(points, {}, &Point::mass) - points.begin());
    Lab lab(std::move(scene));
    for (int frame = 1; frame <= 120; ++frame) ASSERT_TRUE(lab.step());
    const double before = lab.scene().state.position[weight].y;
    for (int frame = 1; frame <= 60; ++frame) ASSERT_TRUE(lab.step());
    EXPECT_EQ(std::abs(lab.scene().state.position[weight].y - before) < 5e-3, rubs) << before;
    EXPECT_EQ(before > -0.5, rubs) << before;
  }
}

TEST(ShippedScenes, AllDominoesFall) {
  const Scene scene = shipped("dominoes");
  Lab lab(scene);
  for (int frame = 1; frame <= 180; ++frame) ASSERT_TRUE(lab.step());
  for (std::size_t i = 0; i < scene.state.position.size(); ++i)
    if (scene.state.position[i].y > 0.2) {
      EXPECT_LT(lab.scene().state.position[i].y, 0.12) << i;
    }
}

TEST(ShippedScenes, SayInTwoSentencesWhatToTryAndWhatToExpect) {
  for (const ShippedScene& shipped_scene : shipped_scenes()) {
    const std::string text = shipped(shipped_scene.id).description;
    int sentences = 0;
    for (std::size_t i = 0; i < text.size(); ++i) sentences += text[i] == '.' && (i + 1 == text.size() || text[i + 1] == ' ');
    EXPECT_EQ(sentences, 2) << shipped_scene.id << ": " << text;
  }
}

// Saved while its hand acts and reopened: the same motion, bit for bit, during the grab and after.
TEST(ShippedScenes, TheFastMouseContinuesFromASavedFile) {
  const auto go_on = [](Scene scene, int frames) {
    Lab lab(std::move(scene), KeepStart::No);
    for (int i = 0; i < frames; ++i) EXPECT_TRUE(lab.step());
    return lab.scene();
  };
  const Scene half = go_on(shipped("fast_mouse"), 20);
  const Scene whole = go_on(half, 15), again = go_on(parse_scene(format_scene(half), "half").scene, 15);
  EXPECT_EQ(again.state.position, whole.state.position);
  EXPECT_EQ(again.state.velocity, whole.state.velocity);
  EXPECT_EQ(again.system.scripted_hand, whole.system.scripted_hand);
  EXPECT_GT(glm::length(whole.state.velocity[0]), 10.0);
}

struct SpringFigures {
  double stiffness, damping, rest_length;
};

void expect_springs(const Scene& scene, const SpringFigures& figures) {
  for (const Spring& spring : scene.system.springs()) {
    EXPECT_EQ(spring.stiffness, figures.stiffness);
    EXPECT_EQ(spring.damping, figures.damping);
    EXPECT_EQ(spring.rest_length, figures.rest_length);
  }
}

void expect_plane_scene(const Scene& scene) {
  EXPECT_EQ(scene.system.dimensions, 2);
  EXPECT_EQ(scene.settings.speed, 0.4);
  EXPECT_EQ(scene.system.gravity, Vec3(0.0, -9.8, 0.0));
}

TEST(ShippedScenes, TwoMassesHasTheFiguresOfTheLecture) {
  for (const auto& [id, stiffness, damping] : {std::tuple{"two_masses", 100.0, 100.0}, {"two_masses_bouncy", 50.0, 0.0}}) {
    const Scene scene = shipped(id);
    expect_plane_scene(scene);
    ASSERT_EQ(scene.system.point_count(), 2);
    EXPECT_EQ(scene.state.position, (std::vector<Vec3>{{0.0, 0.5, 0.0}, {0.5, 0.5, 0.0}}));
    EXPECT_TRUE(scene.system.points()[0].nailed && !scene.system.points()[1].nailed);
    EXPECT_EQ(scene.system.points()[0].color, (Color{255, 105, 180}));
    EXPECT_EQ(scene.system.points()[1].color, (Color{255, 255, 0}));
    for (const Point& point : scene.system.points()) {
      EXPECT_EQ(point.mass, 1.0);
      EXPECT_EQ(point.radius, 0.03);
    }
    ASSERT_EQ(scene.system.spring_count(), 1);
    expect_springs(scene, {stiffness, damping, 0.5});

    // two walls and a floor that are only drawn
    ASSERT_EQ(scene.system.colliders.size(), 3u);
    const Plane planes[] = {{{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, {{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}}, {{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}}};
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(std::get<Plane>(scene.system.colliders[c].shape), planes[c]);
      EXPECT_FALSE(scene.system.colliders[c].solid);
    }
  }
}

TEST(ShippedScenes, ThreeMassesHasTheFiguresOfTheLecture) {
  const Scene scene = shipped("three_masses");
  expect_plane_scene(scene);
  EXPECT_EQ(scene.state.position, (std::vector<Vec3>{{0.0, 0.5, 0.0}, {0.5, 0.1, 0.0}, {0.25, -0.4, 0.0}}));
  for (Index i = 0; i < 3; ++i) EXPECT_EQ(scene.system.points()[i].nailed, i == 0);
  ASSERT_EQ(scene.system.spring_count(), 2);
  for (Index s = 0; s < 2; ++s) {
    EXPECT_EQ(scene.system.index_of(scene.system.springs()[s].first), s);
    EXPECT_EQ(scene.system.index_of(scene.system.springs()[s].second), s + 1);
  }
  expect_springs(scene, {70.0, 10.0, 0.5});
}

TEST(ShippedScenes, TheGridsConnectEveryPointToItsUpToEightNeighbors) {
  for (const char* id : {"grid_4x4", "grid_4x4_true"}) {
    const Scene scene = shipped(id);
    expect_plane_scene(scene);
    ASSERT_EQ(scene.system.point_count(), 16);
    for (Index i = 0; i < 16; ++i) {
      const Index row = i / 4, column = i % 4;
      EXPECT_NEAR(scene.state.position[i].x, -0.6 + 0.4 * column, 1e-15);
      EXPECT_NEAR(scene.state.position[i].y, 0.6 - 0.4 * row, 1e-15);
      EXPECT_EQ(scene.system.points()[i].nailed, i == 0 || i == 3);
    }
    std::set<std::pair<Index, Index>> joined;
    for (const Spring& spring : scene.system.springs()) {
      const Index i = scene.system.index_of(spring.first), j = scene.system.index_of(spring.second);
      EXPECT_TRUE(joined.insert(std::minmax(i, j)).second);
      EXPECT_EQ(spring.stiffness, 100.0);
      EXPECT_EQ(spring.damping, 50.0);
      const double drawn = glm::length(scene.state.position[j] - scene.state.position[i]);
      EXPECT_EQ(spring.rest_length, scene.name == "Grid 4 x 4" ? 0.5 : drawn);
    }
    for (Index i = 0; i < 16; ++i)
      for (Index j = i + 1; j < 16; ++j) EXPECT_EQ(joined.contains({i, j}), std::abs(i % 4 - j % 4) <= 1 && std::abs(i / 4 - j / 4) <= 1);
  }
}

TEST(ShippedScenes, TheAssignmentIsAnEmptySceneWithItsOwnControls) {
  const Scene scene = shipped("assignment");
  EXPECT_EQ(scene.system.point_count(), 0);
  ASSERT_EQ(scene.system.colliders.size(), 1u);
  EXPECT_TRUE(scene.system.colliders[0].solid);
  EXPECT_EQ(scene.defaults.mass, 0.01);
  EXPECT_EQ(scene.controls, (ControlRanges{0.1, 10.0, 0.1}));
}

TEST(ShippedScenes, UnstableAndStableAreTheSameNetUnderTwoMethods) {
  const Scene unstable = shipped("unstable"), stable = shipped("stable");
  EXPECT_EQ(unstable.system, stable.system);
  EXPECT_EQ(unstable.state, stable.state);
  EXPECT_EQ(unstable.settings.integrator->id, "explicit_euler");
  EXPECT_EQ(stable.settings.integrator->id, "symplectic_euler");
  ASSERT_EQ(stable.system.point_count(), 64);
  EXPECT_EQ(stable.system.spring_count(), 2 * 8 * 7);
  for (Index i = 0; i < 64; ++i) {
    EXPECT_DOUBLE_EQ(stable.system.points()[i].mass, 0.01);
    EXPECT_EQ(stable.system.points()[i].nailed, i < 8);
  }
  for (const Spring& spring : stable.system.springs()) {
    EXPECT_EQ(spring.stiffness, 10.0);
    EXPECT_NEAR(spring.rest_length, 0.1, 1e-15);
  }
}

TEST(ShippedScenes, TheClothHangsByTwoCornersAndTheOtherFallsOnABall) {
  const Scene cloth = shipped("cloth"), ball = shipped("cloth_on_ball");
  ASSERT_EQ(cloth.system.point_count(), 32 * 32);
  for (Index i = 0; i < 32 * 32; ++i) EXPECT_EQ(cloth.system.points()[i].nailed, i == 0 || i == 31);
  EXPECT_EQ(cloth.system.dimensions, 3);
  EXPECT_EQ(cloth.system.gravity, Vec3(0.0, -9.81, 0.0));
  for (const Point& point : ball.system.points()) EXPECT_FALSE(point.nailed);
  ASSERT_EQ(ball.system.colliders.size(), 2u);
  for (const Collider& collider : ball.system.colliders) EXPECT_TRUE(collider.solid);
}

// Points on the far side of the sphere or below the ground would mean that the cloth passed through. Without contact of its faces, which
// takes longer.
TEST(ShippedScenes, TheClothRestsOnTheBallAndSlidesOffWithoutFriction) {
  const auto mean_height_after_two_seconds = [](double friction) {
    Scene scene = shipped("cloth_on_ball");
    scene.system.contact = {};
    for (Collider& collider : scene.system.colliders) collider.friction = friction;
    const Sphere ball = std::get<Sphere>(scene.system.colliders[0].shape);
    const Plane ground = std::get<Plane>(scene.system.colliders[1].shape);
    Lab lab(std::move(scene));
    for (int frame = 0; frame < 120; ++frame) EXPECT_TRUE(lab.step());
    double sum = 0.0;
    const State& state = lab.scene().state;
    for (std::size_t i = 0; i < state.position.size(); ++i) {
      const double radius = lab.scene().system.points()[i].radius;
      EXPECT_GT(glm::length(state.position[i] - ball.center), ball.radius + radius - 1e-9);
      EXPECT_GT(state.position[i].y, ground.point.y + radius - 1e-9);
      sum += state.position[i].y;
    }
    return sum / static_cast<double>(state.position.size());
  };
  EXPECT_GT(mean_height_after_two_seconds(shipped("cloth_on_ball").system.colliders[0].friction), 0.0);
  EXPECT_LT(mean_height_after_two_seconds(0.0), -0.4);
}

TEST(ShippedScenes, TheMeasuredSheetsHaveTheirPublishedFigures) {
  for (const char* id : {"drum_32", "cloth_32"}) {
    const Scene scene = shipped(id);
    ASSERT_EQ(scene.system.point_count(), 1024);
    EXPECT_EQ(scene.system.spring_count(), 3906);
    EXPECT_EQ(scene.system.gravity, Vec3(0.0, 0.0, -9.81));
    EXPECT_EQ(scene.system.drag, 0.0);
    for (Index i = 0; i < 1024; ++i) {
      const Index row = i / 32, column = i % 32;
      EXPECT_NEAR(glm::length(scene.state.position[i] - Vec3(column / 31.0, -row / 31.0, 0.0)), 0.0, 1e-15);
      EXPECT_EQ(scene.system.points()[i].mass, 0.2 / 1024);
      const bool border = row == 0 || row == 31 || column == 0 || column == 31;
      EXPECT_EQ(scene.system.points()[i].nailed, scene.name == "Drum 32" ? border : i == 0 || i == 31);
    }
    for (const Spring& spring : scene.system.springs()) {
      const bool diagonal = spring.rest_length > 1.2 / 31;
      EXPECT_NEAR(spring.rest_length, (diagonal ? std::sqrt(2.0) : 1.0) / 31, 1e-15);
      EXPECT_EQ(spring.stiffness, diagonal ? 500.0 : 1000.0);
      EXPECT_EQ(spring.damping, 0.0);
    }
  }
}

TEST(ShippedScenes, TheMeasuredRopeHasItsPublishedFigures) {
  const Scene scene = shipped("rope_64");
  ASSERT_EQ(scene.system.point_count(), 64);
  ASSERT_EQ(scene.system.spring_count(), 63);
  EXPECT_EQ(scene.system.gravity, Vec3(0.0, 0.0, -9.81));
  for (Index i = 0; i < 64; ++i) {
    EXPECT_NEAR(glm::length(scene.state.position[i] - Vec3(i / 63.0, 0.0, 0.0)), 0.0, 1e-15);
    EXPECT_EQ(scene.system.points()[i].mass, 0.1 / 64);
    EXPECT_EQ(scene.system.points()[i].nailed, i == 0);
  }
  for (const Spring& spring : scene.system.springs()) {
    EXPECT_EQ(spring.stiffness, 1e4);
    EXPECT_EQ(spring.damping, 0.0);
    EXPECT_NEAR(spring.rest_length, 1.0 / 63, 1e-15);
  }
}

std::string scene_format_page() { return contents(DOCS_FOLDER "/reference/scene-format.md"); }

TEST(SceneFormatPage, ItsExampleLoadsWithoutWarnings) {
  const std::string page = scene_format_page();
  const std::size_t begin = page.find("```json\n") + 8, end = page.find("```", begin);
  const LoadedScene loaded = parse_scene(page.substr(begin, end - begin), "example");
  EXPECT_EQ(loaded.warnings, std::vector<std::string>{});
  EXPECT_EQ(loaded.scene.system.point_count(), 22);
}

TEST(SceneFormatPage, DescribesEveryForce) {
  const std::string page = scene_format_page();
  for (const ForceTerm& term : force_terms()) {
    const std::size_t row = page.find("| `" + std::string(term.id) + "` |", page.find("### Forces"));
    ASSERT_NE(row, std::string::npos) << term.id;
    const std::string line = page.substr(row, page.find('\n', row) - row);
    for (const ForceParameter& number : term.numbers)
      EXPECT_NE(line.find("`" + std::string(number.name) + "`"), std::string::npos) << term.id << ' ' << number.name;
  }
}

}  // namespace
}  // namespace hooke
