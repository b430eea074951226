// How colliders are drawn whose surface moves while their shape does not.
#include <gtest/gtest.h>

#include <numbers>

#include "support/picture.h"

namespace hooke {
namespace {

constexpr double quarter = 0.25;  // [s], a quarter of a period at one revolution per second

Collider spinning(const Vec3& axis) { return {.shape = Sphere{Vec3(0.0), 0.8}, .path = {.spin = 2.0 * std::numbers::pi * axis}}; }

Image picture_at(const Collider& collider, double time, int dimensions = 3) {
  TestSim scene;
  scene.system.dimensions = dimensions;
  scene.system.colliders = {collider};
  scene.state.time = time;
  const Camera camera = make_camera({.camera = CameraPose{.eye = {0.6, 1.0, 3.0}, .target = Vec3(0.0), .orthographic = dimensions == 2}},
                                    scene.system, scene.state, 1.0);
  return draw(scene, {}, dimensions == 2 ? make_camera({}, scene.system, scene.state, 1.0) : camera, {}, 200, 200);
}

// The difference between the pictures at time 0 and at `time`.
double change(const Collider& collider, double time, int dimensions = 3) {
  return difference(picture_at(collider, 0.0, dimensions), picture_at(collider, time, dimensions));
}

TEST(SurfaceMotion, ASpinningBallChangesInThePicture) {
  EXPECT_GT(change(spinning({0.0, 1.0, 0.0}), 0.4 * quarter), 0.02);
  EXPECT_LT(change(spinning({0.0, 1.0, 0.0}), 4.0 * quarter), 1e-4);  // a full revolution
  EXPECT_EQ(change({.shape = Sphere{Vec3(0.0), 0.8}}, quarter), 0.0);
}

// Features drawn at an angle about the axis move by the rotation angle of the ball, in the direction of rotation.
TEST(SurfaceMotion, ABallRotatesInTheDirectionOfItsSpin) {
  TestSim scene;
  scene.system.colliders = {spinning({0.0, 1.0, 0.0})};
  const Camera camera = make_camera({.camera = CameraPose{.eye = {0.0, 3.0, 0.01}, .target = Vec3(0.0), .up = Vec3(0.0, 0.0, -1.0)}},
                                    scene.system, scene.state, 1.0);
  const double turned = 0.35;
  const Image start = draw(scene, {}, camera, {}, 300, 300);
  scene.state.time = turned / (2.0 * std::numbers::pi);
  const Image later = draw(scene, {}, camera, {}, 300, 300);
  const auto shade_at = [&](const Image& image, double angle) {
    // seen from above, counter-clockwise from x is towards -z
    const Vec3 place = 0.5 * Vec3(std::cos(angle), 0.0, -std::sin(angle)) + Vec3(0.0, 0.6, 0.0);
    const Color seen = at(image, camera, place);
    return seen.red + seen.green + seen.blue;
  };
  int forward = 0, backward = 0;
  for (double angle = 0.0; angle < 6.2; angle += 0.25) {
    forward += std::abs(shade_at(later, angle + turned) - shade_at(start, angle));
    backward += std::abs(shade_at(later, angle - turned) - shade_at(start, angle));
  }
  EXPECT_LT(3 * forward, backward);
}

TEST(SurfaceMotion, TheGridOfATurntableRotatesAndThatOfABeltTranslates) {
  const Collider still{.shape = Plane{}};
  Collider turning = still, running = still, swinging = still;
  turning.path.spin = {0.0, 1.0, 0.0};
  running.path.belt = {0.1, 0.0, 0.0};
  swinging.path.amplitude = {0.07, 0.0, 0.0};
  EXPECT_EQ(change(still, quarter), 0.0);
  for (const Collider& collider : {turning, running, swinging}) EXPECT_GT(change(collider, quarter), 0.005);
  EXPECT_LT(change(running, 100.0), 0.002);  // shifted by ten of the wider cells
}

TEST(SurfaceMotion, LinesMoveAlongABoxWithABelt) {
  const Collider still{.shape = Box{{-0.8, -0.3, -0.4}, {0.8, 0.0, 0.4}}};
  Collider belt = still;
  belt.path.belt = {0.4, 0.0, 0.0};  // half the distance between two lines in a quarter of a second
  EXPECT_EQ(change(still, quarter), 0.0);
  EXPECT_GT(change(belt, quarter), 0.005);
  EXPECT_LT(change(belt, 2.0 * quarter), 1e-4);
  EXPECT_GT(change(belt, quarter, 2), 0.005);
}

TEST(SurfaceMotion, ADiscOfAFlatSceneVisiblyRotates) {
  EXPECT_GT(change(spinning({0.0, 0.0, 1.0}), 0.4 * quarter, 2), 0.005);
  EXPECT_LT(change(spinning({0.0, 0.0, 1.0}), 4.0 * quarter, 2), 1e-4);
}

}  // namespace
}  // namespace hooke
