// The geometry of the camera.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "draw/camera.h"
#include "draw/camera_text.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

const glm::dvec2 size(1280, 720);

// Cameras in all directions, near and far, in both projections.
std::vector<Camera> cameras() {
  std::vector<Camera> all;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> turn(-3.0, 3.0), place(-2.0, 2.0);
  for (const bool orthographic : {false, true})
    for (int i = 0; i < 20; ++i) {
      Camera camera{.target = {place(random), place(random), place(random)}, .distance = std::exp(2.0 * turn(random))};
      camera.orthographic = orthographic;
      camera.orbit(turn(random), 0.5 * turn(random));
      all.push_back(camera);
    }
  return all;
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance) { EXPECT_LT(glm::length(a - b), tolerance); }

TEST(Camera, UnprojectInvertsProject) {
  for (const Camera& camera : cameras()) {
    const Vec3 place = camera.target + 0.3 * camera.distance * Vec3(0.3, -0.5, 0.4);
    const Vec3 seen = camera.project(place, size);
    EXPECT_GT(seen.z, 0.0);
    EXPECT_LT(seen.z, 1.0);
    expect_near(camera.unproject({seen.x, seen.y}, size, place), place, 1e-9 * camera.distance);
  }
}

TEST(Camera, RayThroughAPixelPassesThroughThePositionShownThere) {
  for (const Camera& camera : cameras()) {
    const Vec3 place = camera.target + 0.3 * camera.distance * Vec3(-0.2, 0.4, 0.6);
    const Vec3 seen = camera.project(place, size);
    const Ray ray = camera.ray_through({seen.x, seen.y}, size);
    EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-12);
    EXPECT_LT(glm::length(glm::cross(place - ray.origin, ray.direction)), 1e-9 * camera.distance);
    EXPECT_GT(glm::dot(place - ray.origin, ray.direction), 0.0);
  }
}

TEST(Camera, ProjectsLikeItsMatrices) {
  for (const Camera& camera : cameras()) {
    const Vec3 place = camera.target + 0.3 * camera.distance * Vec3(0.1, 0.2, -0.6);
    const glm::dvec4 clip = camera.projection_matrix(size.x / size.y) * camera.view_matrix() * glm::dvec4(place, 1.0);
    const Vec3 seen = camera.project(place, size);
    EXPECT_NEAR(seen.x, (clip.x / clip.w + 1.0) * 0.5 * size.x, 1e-6);
    EXPECT_NEAR(seen.y, (1.0 - clip.y / clip.w) * 0.5 * size.y, 1e-6);
    EXPECT_NEAR(seen.z, (clip.z / clip.w + 1.0) * 0.5, 1e-9);
  }
}

TEST(Camera, ShowsItsTargetAtTheCenterWithUpUpwards) {
  for (const Camera& camera : cameras()) {
    const Vec3 middle = camera.project(camera.target, size);
    EXPECT_NEAR(middle.x, 640.0, 1e-9);
    EXPECT_NEAR(middle.y, 360.0, 1e-9);
    EXPECT_LT(camera.project(camera.target + 0.1 * camera.distance * camera.up, size).y, 360.0);
  }
}

TEST(Camera, DoesNotProjectPositionsBehindTheEye) {
  const Camera camera;
  const Vec3 seen = camera.project(camera.eye() + camera.back, size);
  EXPECT_FALSE(std::isfinite(seen.x));
  EXPECT_GT(seen.z, 1.0);
}

TEST(Camera, ZoomKeepsThePositionUnderTheCursor) {
  const glm::dvec2 cursor(1000, 150);
  for (Camera camera : cameras()) {
    const Ray ray = camera.ray_through(cursor, size);
    const double distance = camera.distance;
    const Vec3 under = camera.unproject(cursor, size, camera.target);
    camera.zoom(0.5, cursor, size);
    EXPECT_NEAR(camera.distance, 0.5 * distance, 1e-12 * distance);
    const Vec3 seen = camera.project(under, size);
    EXPECT_NEAR(seen.x, cursor.x, 1e-6);
    EXPECT_NEAR(seen.y, cursor.y, 1e-6);
    // this also holds for any position on the same ray, in front of or behind the target plane
    const Vec3 beyond = camera.project(under + 0.2 * distance * ray.direction, size);
    EXPECT_NEAR(beyond.x, cursor.x, 1e-6);
    EXPECT_NEAR(beyond.y, cursor.y, 1e-6);
  }
}

TEST(Camera, ZoomIsLimited) {
  Camera camera;
  for (int i = 0; i < 1000; ++i) camera.zoom(0.5, {0, 0}, size);
  EXPECT_GT(camera.distance, 0.0);
  for (int i = 0; i < 1000; ++i) camera.zoom(2.0, {0, 0}, size);
  EXPECT_TRUE(std::isfinite(camera.distance));
  EXPECT_TRUE(std::isfinite(glm::length(camera.target)));
}

TEST(Camera, PanMovesTheTargetPlaneWithTheCursor) {
  for (Camera camera : cameras()) {
    const glm::dvec2 from(200, 500), to(700, 300);
    const Vec3 held = camera.unproject(from, size, camera.target);
    camera.pan(from, to, size);
    const Vec3 seen = camera.project(held, size);
    EXPECT_NEAR(seen.x, to.x, 1e-6);
    EXPECT_NEAR(seen.y, to.y, 1e-6);
  }
}

TEST(Camera, OrbitNeverFlips) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> turn(-2.0, 2.0);
  for (Camera camera : cameras()) {
    const Vec3 target = camera.target;
    const double distance = camera.distance;
    for (int i = 0; i < 200; ++i) {
      camera.orbit(turn(random), turn(random));
      EXPECT_GE(glm::dot(camera.up, camera.pole), -1e-12);
      EXPECT_NEAR(glm::length(camera.back), 1.0, 1e-12);
      EXPECT_NEAR(glm::length(camera.up), 1.0, 1e-12);
      EXPECT_NEAR(glm::dot(camera.up, camera.back), 0.0, 1e-12);
    }
    EXPECT_EQ(camera.target, target);
    EXPECT_EQ(camera.distance, distance);
  }
}

TEST(Camera, OrbitContinuesFromStraightAbove) {
  Camera camera;
  camera.orbit(0.0, 10.0);
  expect_near(camera.back, camera.pole, 1e-12);
  camera.orbit(0.5, -0.3);
  EXPECT_NEAR(std::acos(glm::dot(camera.back, camera.pole)), 0.3, 1e-12);
}

TEST(Camera, OrbitRotatesAboutThePoleByTheAngle) {
  Camera camera;
  camera.orbit(0.5, 0.0);
  expect_near(camera.back, {std::sin(0.5), 0.0, std::cos(0.5)}, 1e-12);
  camera.orbit(0.0, 0.25);
  EXPECT_NEAR(camera.back.y, std::sin(0.25), 1e-12);
}

TEST(Camera, BothProjectionsShowTheTargetAtTheSameSize) {
  for (Camera camera : cameras()) {
    const Vec3 beside = camera.target + 0.1 * camera.distance * camera.up;
    const Vec3 seen = camera.project(beside, size);
    camera.orthographic = !camera.orthographic;
    expect_near(Vec3(seen.x, seen.y, 0.0), Vec3(camera.project(beside, size).x, camera.project(beside, size).y, 0.0), 1e-6);
  }
}

TEST(Camera, ComputesTheMetersPerPixel) {
  for (const Camera& camera : cameras()) {
    const Vec3 place = camera.target - 0.4 * camera.distance * camera.back;
    const double meters = camera.meters_per_pixel(place, size);
    const Vec3 seen = camera.project(place, size), above = camera.project(place + 10.0 * meters * camera.up, size);
    EXPECT_NEAR(seen.y - above.y, 10.0, 1e-6);
  }
}

TestSim scattered(int dimensions) {
  TestSim sim;
  sim.system.dimensions = dimensions;
  sim.add({-3.0, 1.0, 0.0});
  sim.add({2.0, 4.0, dimensions == 3 ? 5.0 : 0.0});
  sim.add({0.0, -2.0, 0.0});
  return sim;
}

void expect_all_seen(const Camera& camera, const TestSim& sim, const glm::dvec2& picture) {
  glm::dvec2 min(1e9), max(-1e9);
  for (const Vec3& place : sim.state.position) {
    const Vec3 seen = camera.project(place, picture);
    min = glm::min(min, glm::dvec2(seen.x, seen.y));
    max = glm::max(max, glm::dvec2(seen.x, seen.y));
    EXPECT_GT(seen.z, 0.0);
    EXPECT_LT(seen.z, 1.0);
  }
  EXPECT_GT(min.x, 0.0);
  EXPECT_GT(min.y, 0.0);
  EXPECT_LT(max.x, picture.x);
  EXPECT_LT(max.y, picture.y);
  EXPECT_GT(std::max((max.x - min.x) / picture.x, (max.y - min.y) / picture.y), 0.5);
}

TEST(Camera, FramesTheWholeScene) {
  for (const int dimensions : {2, 3})
    for (const glm::dvec2 picture : {glm::dvec2(1280, 720), glm::dvec2(300, 900)}) {
      const TestSim sim = scattered(dimensions);
      const Camera camera = make_camera({}, sim.system, sim.state, picture.x / picture.y);
      EXPECT_EQ(camera.orthographic, dimensions == 2);
      expect_all_seen(camera, sim, picture);
    }
}

TEST(Camera, FramesWithoutRotating) {
  const TestSim sim = scattered(3);
  for (Camera camera : cameras()) {
    const Vec3 back = camera.back;
    frame_scene(camera, sim.system, sim.state, size.x / size.y);
    EXPECT_EQ(camera.back, back);
    expect_all_seen(camera, sim, size);
  }
}

TEST(Camera, FramesEmptySinglePointAndNonFiniteScenes) {
  TestSim sim;
  for (int i = 0; i < 3; ++i) {
    const Camera camera = make_camera({}, sim.system, sim.state, 1.0);
    EXPECT_TRUE(std::isfinite(camera.distance));
    EXPECT_GT(camera.distance, 0.0);
    EXPECT_TRUE(std::isfinite(glm::length(camera.target)));
    sim.add(i == 0 ? Vec3(1.0, 2.0, 3.0) : Vec3(std::nan("")));
  }
}

TEST(Camera, FramesTheWholePathOfACollider) {
  TestSim sim;
  sim.add(Vec3(0.0));
  sim.system.colliders = {{.shape = Sphere{{0.0, 0.0, 0.0}, 0.2}, .path = {.amplitude = {3.0, 0.0, 0.0}, .frequency = 0.5}}};
  Camera home = make_camera({}, sim.system, sim.state, size.x / size.y);
  for (int i = 0; i < 2; ++i) {
    for (const double x : {-3.2, 3.2}) {
      const Vec3 seen = home.project({x, 0.0, 0.0}, size);
      EXPECT_GT(seen.x, 0.0) << x;
      EXPECT_LT(seen.x, size.x) << x;
    }
    frame_scene(home, sim.system, sim.state, size.x / size.y);
  }

  // a collider displaced from its initial position is shown there
  sim.system.colliders[0].path = {.amplitude = {0.0, 5.0, 0.0}, .frequency = 0.0, .phase = 1.5707963267948966};
  const Camera still = make_camera({}, sim.system, sim.state, size.x / size.y);
  EXPECT_GT(still.project({0.0, 5.2, 0.0}, size).y, 0.0);
}

TEST(Camera, FollowsByTheSmallestNecessaryMove) {
  TestSim sim = scattered(3);
  Camera camera = make_camera({}, sim.system, sim.state, size.x / size.y);
  const auto move_all = [&](const Vec3& displacement) {
    for (Vec3& place : sim.state.position) place += displacement;
  };
  const Vec3 before = camera.target;
  move_all({1e3, 0.0, 0.0});
  follow_scene(camera, sim.state);
  EXPECT_EQ(camera.target, before);  // following is off

  camera.follows = true;
  follow_scene(camera, sim.state);
  const auto middle = [&] { return (sim.state.position[0] + sim.state.position[1] + sim.state.position[2]) / 3.0; };
  const Vec3 seen = camera.project(middle(), size), there = camera.target;
  EXPECT_NEAR(seen.x, 0.5 * size.x + 0.3 * size.y, 1.0);  // the point moved to the right, and is shown there
  EXPECT_GT(seen.y, 0.19 * size.y);
  EXPECT_LT(seen.y, 0.81 * size.y);

  // the camera does not move while the point is in the middle of the picture
  move_all(0.5 * (camera.target - middle()));
  follow_scene(camera, sim.state);
  EXPECT_NEAR(glm::distance(camera.target, there), 0.0, 1e-9);

  sim.state.position[0] = Vec3(std::nan(""));
  follow_scene(camera, sim.state);
  EXPECT_TRUE(std::isfinite(glm::length(camera.target)));
}

TEST(Camera, LeavesSpaceForTheExpectedSag) {
  TestSim rope;
  rope.nail({0.0, 0.0, 0.0});
  rope.add({1.0, 0.0, 0.0});
  const Camera camera = make_camera({}, rope.system, rope.state, size.x / size.y);
  const Vec3 hanging = camera.project({0.0, -1.0, 0.0}, size);
  EXPECT_LT(hanging.y, size.y);
}

TEST(Camera, StartsAtTheViewpointOfTheScene) {
  const TestSim sim = scattered(3);
  const CameraPose pose{.eye = {1.0, 2.0, 5.0}, .target = {1.0, 0.0, 1.0}, .up = Vec3(0.0, 0.0, 1.0), .orthographic = true};
  const Camera camera = make_camera({.camera = pose}, sim.system, sim.state, 1.5);
  expect_near(camera.eye(), pose.eye, 1e-12);
  expect_near(camera.target, pose.target, 1e-12);
  EXPECT_TRUE(camera.orthographic);
  EXPECT_GT(camera.up.z, 0.0);
  EXPECT_NEAR(camera.up.x, 0.0, 1e-12);

  const CameraPose again = pose_of(camera);
  expect_near(again.eye, pose.eye, 1e-12);
  expect_near(*again.up, *pose.up, 1e-12);
}

TEST(Camera, UpIsAgainstGravity) {
  TestSim sim = scattered(3);
  sim.system.gravity = {0.0, 0.0, -9.81};
  const Camera camera = make_camera({}, sim.system, sim.state, 1.5);
  EXPECT_GT(camera.up.z, 0.9);
  EXPECT_GT(camera.back.z, 0.0);
}

TEST(CameraText, ReadsBackAsTheSameNumbers) {
  const CameraPose pose{.eye = {0.1, -2.0 / 3.0, 1e-9}, .target = {1e6, 0.0, -0.25}, .orthographic = true};
  const auto read = camera_from_text(camera_text(pose));
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, pose);
  EXPECT_EQ(camera_text({.eye = {0.0, 0.0, 3.0}}), "0,0,3,0,0,0");
}

TEST(CameraText, RejectsAnythingElse) {
  for (const char* text : {"", "1,2,3", "1,2,3,4,5,6,7", "1,2,3,1,2,3", "nan,0,0,0,0,0", "1e999,0,0,0,0,0", "1,2,3,4,5,6,ortho", "a"})
    EXPECT_FALSE(camera_from_text(text)) << text;
  EXPECT_TRUE(camera_from_text("1,2,3,0,0,0\n"));
}

}  // namespace
}  // namespace hooke
