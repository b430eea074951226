// The same physics in other units, at another place, in another orientation, in a mirror and with its parts in another order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <glm/geometric.hpp>

#include "support/convergence.h"
#include "support/folds.h"
#include "support/shuffled.h"

namespace hooke {
namespace {

// Two sheets with dashpots, the second across the first and partly within its thickness, fall on a ball and a floor, and so does a small
// ball.
TestSim draping() {
  TestSim sim;
  sim.system.drag = 0.3;
  const auto rest = [](double, double) { return Vec3(0.1, -1.0, 0.05); };
  folds::add_sheet(
      sim, 5, [](double u, double v) { return Vec3(0.3 * u, 0.21 + 0.01 * u * v, 0.3 * v); }, rest);
  folds::add_sheet(
      sim, 5, [](double u, double v) { return Vec3(0.05 + 0.3 * u, 0.218 + 0.05 * u, 0.02 + 0.28 * v); }, rest);
  std::vector<Spring> springs(sim.system.springs().begin(), sim.system.springs().end());
  for (Spring& spring : springs) {
    spring.rest_length *= 0.3;
    spring.damping = 0.01;
  }
  sim.system.set_springs(springs);
  const PointId ball = sim.add({0.2, 0.35, 0.15}, 0.02, {0.0, -2.0, 0.0});
  sim.system.point(sim.system.index_of(ball)).radius = 0.02;
  sim.system.colliders = {{.shape = Plane{}, .friction = 0.3}, {.shape = Sphere{{0.12, 0.1, 0.13}, 0.1}, .friction = 0.3}};
  sim.system.contact = {.points = true, .faces = true, .thickness = 0.01, .friction = 0.3};
  return sim;
}

// Balls of which two overlap at the start, on a floor and one onto another.
TestSim heap() {
  TestSim sim;
  for (const Vec3& x : {Vec3(0.0, 0.02, 0.0), Vec3(0.035, 0.02, 0.004), Vec3(0.09, 0.02, 0.0), Vec3(0.1, 0.07, 0.01)}) {
    const PointId ball = sim.add(x, 0.02, {-0.2, -0.3, 0.1});
    sim.system.point(sim.system.index_of(ball)).radius = 0.02;
  }
  sim.system.colliders = {{.shape = Plane{}, .friction = 0.3}};
  sim.system.contact = {.points = true, .restitution = 0.3, .friction = 0.3};
  return sim;
}

// In units in which lengths, times and masses have so many times their value.
TestSim in_units(TestSim sim, double length, double time, double mass) {
  System& system = sim.system;
  system.gravity *= length / (time * time);
  system.drag /= time;
  for (Index i = 0; i < system.point_count(); ++i) {
    Point& point = system.point(i);
    point.mass *= mass;
    point.radius *= length;
  }
  std::vector<Spring> springs(system.springs().begin(), system.springs().end());
  for (Spring& spring : springs) {
    spring.stiffness *= mass / (time * time);
    spring.damping *= mass / time;
    spring.rest_length *= length;
  }
  system.set_springs(springs);
  for (Collider& collider : system.colliders)
    if (Sphere* sphere = std::get_if<Sphere>(&collider.shape)) sphere->center *= length, sphere->radius *= length;
  system.contact.thickness *= length;
  system.contact.frequency /= time;
  for (Vec3& x : sim.state.position) x *= length;
  for (Vec3& v : sim.state.velocity) v *= length / time;
  return sim;
}

// With its vectors changed by `turn`, and then moved.
TestSim moved(TestSim sim, const std::function<Vec3(const Vec3&)>& turn, const Vec3& displacement) {
  sim.system.gravity = turn(sim.system.gravity);
  for (Collider& collider : sim.system.colliders) {
    if (Sphere* sphere = std::get_if<Sphere>(&collider.shape)) sphere->center = turn(sphere->center) + displacement;
    if (Plane* plane = std::get_if<Plane>(&collider.shape)) *plane = {turn(plane->point) + displacement, turn(plane->normal)};
  }
  for (Vec3& x : sim.state.position) x = turn(x) + displacement;
  for (Vec3& v : sim.state.velocity) v = turn(v);
  return sim;
}

void advance(TestSim& sim, double seconds, int substeps, const Integrator& method) {
  for (int i = 0; i < 20; ++i) sim.run(method, seconds / 20, substeps);
}

constexpr int substeps = 20;  // in each of 20 frames

// [m], the largest distance of a point from where it is in the original.
template <class Back>
double difference(const TestSim& original, const TestSim& sim, const Back& back) {
  double max = 0.0;
  for (const Point& point : original.system.points())
    max = std::max(max, glm::distance(original.position(point.id), back(sim.position(point.id))));
  return max;
}

class ContactIsTheSame : public testing::TestWithParam<const Integrator*> {};
INSTANTIATE_TEST_SUITE_P(Methods, ContactIsTheSame, testing::ValuesIn(every_method()), method_name);

// To rounding, which the motion of the sheets amplifies: it is chaotic from 0.03 s on.
TEST_P(ContactIsTheSame, InOtherUnits) {
  constexpr double seconds = 0.02;
  for (TestSim (*make)() : {draping, heap}) {
    TestSim original = make(), scaled = in_units(make(), 1000.0, 1000.0, 1000.0), other = in_units(make(), 0.1, 10.0, 1e-3);
    advance(original, seconds, substeps, *GetParam());
    advance(scaled, 1000.0 * seconds, substeps, *GetParam());
    advance(other, 10.0 * seconds, substeps, *GetParam());
    const double large = difference(original, scaled, [](const Vec3& x) { return x / 1000.0; });
    const double small = difference(original, other, [](const Vec3& x) { return 10.0 * x; });
    if (std::getenv("HOOKE_PRINT") != nullptr) std::printf("%s: units %.2g %.2g m\n", GetParam()->id.data(), large, small);
    EXPECT_LT(large, 1e-12);
    EXPECT_LT(small, 1e-12);
  }
}

// Balls, to the tolerance of the sweeps over what touches at rest.
TEST_P(ContactIsTheSame, InAnotherOrderOfPoints) {
  TestSim original = heap(), ordered = shuffled(heap());
  advance(original, 0.1, substeps, *GetParam());
  advance(ordered, 0.1, substeps, *GetParam());
  EXPECT_LT(difference(original, ordered, [](const Vec3& x) { return x; }), 1e-8);
}

// Up to the order in which two sweeps act on contacts, which follows places: less than half of what half the substep changes.
TEST_P(ContactIsTheSame, AtAnotherPlaceInAMirrorAndInAnotherOrder) {
  constexpr double seconds = 0.04;
  const Integrator& method = *GetParam();
  TestSim original = draping(), finer = draping(), far = moved(draping(), [](const Vec3&x) { return x; }, {8.0, 3.0, -5.0});
  const auto turn = [](const Vec3& x) {
    return Vec3(0.36 * x.x + 0.48 * x.y - 0.8 * x.z, -0.8 * x.x + 0.6 * x.y, 0.48 * x.x + 0.64 * x.y + 0.6 * x.z);
  };
  const auto back = [](const Vec3& x) {
    return Vec3(0.36 * x.x - 0.8 * x.y + 0.48 * x.z, 0.48 * x.x + 0.6 * x.y + 0.64 * x.z, -0.8 * x.x + 0.6 * x.z);
  };
  const auto mirror = [](const Vec3& x) { return Vec3(x.x, x.y, -x.z); };
  TestSim turned = moved(draping(), turn, Vec3(0.0)), mirrored = moved(draping(), mirror, Vec3(0.0)), ordered = shuffled(draping());
  const std::vector<Face> faces(ordered.system.faces.begin(), ordered.system.faces.end());
  ordered.system.faces = {};
  for (auto face = faces.rbegin(); face != faces.rend(); ++face) ordered.system.faces.push_back(*face);
  std::ranges::reverse(ordered.system.colliders);
  for (TestSim* sim : {&original, &far, &turned, &mirrored, &ordered}) advance(*sim, seconds, substeps, method);
  advance(finer, seconds, 2 * substeps, method);
  const auto same = [](const Vec3& x) { return x; };
  const double half = difference(original, finer, same);
  const double of[] = {difference(original, far, [](const Vec3& x) { return x - Vec3(8.0, 3.0, -5.0); }),
                       difference(original, turned, back), difference(original, mirrored, mirror), difference(original, ordered, same)};
  if (std::getenv("HOOKE_PRINT") != nullptr)
    std::printf("%s: moved %.2g, turned %.2g, mirrored %.2g, in another order %.2g, with half the substep %.2g m\n", method.id.data(),
                of[0], of[1], of[2], of[3], half);
  for (const double each : of) EXPECT_LT(each, 0.5 * half);
}

}  // namespace
}  // namespace hooke
