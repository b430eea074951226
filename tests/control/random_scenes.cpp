#include "control/random_scenes.h"

#include <cmath>
#include <numbers>
#include <random>

#include "sim/forces/force_terms.h"
#include "support/nets.h"

namespace hooke {
namespace {

class Generator {
 public:
  explicit Generator(unsigned long seed) : random_(seed) {}
  double number(double min, double max) { return min + (max - min) * static_cast<double>(random_() >> 11) * 0x1p-53; }
  double power(double min, double max) { return std::pow(10.0, number(min, max)); }
  int count(int min, int max) { return min + static_cast<int>(random_() % static_cast<unsigned long>(max - min + 1)); }
  Vec3 vector(double size, int dimensions = 3) {
    return {number(-size, size), number(-size, size), dimensions == 3 ? number(-size, size) : 0.0};
  }

 private:
  std::mt19937_64 random_;
};

// Points anywhere, each joined to two before it, with springs far from their rest lengths.
TestSim random_net(Generator& random) {
  TestSim sim;
  sim.system.gravity = random.count(0, 1) == 0 ? Vec3(0.0) : Vec3(0.0, -9.81, 0.0);
  sim.system.drag = random.count(0, 2) == 0 ? random.number(0.0, 2.0) : 0.0;
  const int points = random.count(3, 16);
  const bool is_damped = random.count(0, 1) == 0;
  std::vector<PointId> ids{sim.nail(Vec3(0.0))};
  for (int i = 1; i < points; ++i) ids.push_back(sim.add(random.vector(1.0), random.power(-2.0, 1.0), random.vector(1.0)));
  for (std::size_t i = 1; i < ids.size(); ++i)
    for (int j = 0; j < 2; ++j) {
      const PointId other = ids[static_cast<std::size_t>(random.count(0, static_cast<int>(i) - 1))];
      sim.join(ids[i], other, random.power(0.0, 4.0), random.number(0.2, 1.5), is_damped ? random.number(0.0, 2.0) : 0.0);
    }
  return sim;
}

// A chain that is thrown, nailed at one end or at none.
TestSim random_rope(Generator& random) {
  TestSim sim;
  sim.system.gravity = {0.0, -9.81, 0.0};
  const int points = random.count(4, 40);
  const double mass = random.power(-3.0, -1.0), stiffness = random.power(1.0, 4.0), length = 1.0 / points;
  const double damping = random.count(0, 1) == 0 ? random.power(-4.0, -2.0) : 0.0;
  const Vec3 direction = glm::normalize(random.vector(1.0) + Vec3(0.1, 0.0, 0.0));
  PointId before = random.count(0, 3) == 0 ? sim.add(Vec3(0.0), mass) : sim.nail(Vec3(0.0));
  for (int i = 1; i < points; ++i) {
    const PointId next = sim.add(length * i * direction + random.vector(0.1 * length), mass, random.vector(0.5));
    sim.join(before, next, stiffness, length, damping);
    before = next;
  }
  return sim;
}

// One spring, whose end may pass near the nail.
TestSim random_orbit(Generator& random) {
  TestSim sim;
  const PointId center = sim.nail(Vec3(0.0));
  const PointId point = sim.add({1.0, 0.0, 0.0}, random.power(-1.0, 1.0), {0.0, random.power(-1.5, 1.0), 0.0});
  sim.join(center, point, random.power(1.0, 4.5), random.number(0.05, 1.2));
  return sim;
}

TestSim random_cloth(Generator& random) {
  const int n = random.count(4, 10);
  TestSim sim = curtain(n, random.power(1.0, 3.5), random.count(0, 1) == 0 ? random.power(-3.0, -1.0) : 0.0);
  sim.system.gravity = {0.0, -9.81, 0.0};
  for (Vec3& v : sim.state.velocity) v += random.vector(0.05);
  for (Index i = 0; i < sim.system.point_count(); ++i)
    if (sim.system.points()[i].nailed) sim.state.velocity[i] = Vec3(0.0);
  return sim;
}

// Small nets that fall on a floor, some of them with a ball in the way.
TestSim random_contact(Generator& random) {
  TestSim sim;
  sim.system.gravity = {0.0, -9.81, 0.0};
  const double restitution = random.number(0.0, 1.0), friction = random.count(0, 1) == 0 ? random.number(0.0, 1.0) : 0.0;
  sim.system.colliders.push_back(
      {.shape = Plane{.point = Vec3(0.0), .normal = {0.0, 1.0, 0.0}}, .restitution = restitution, .friction = friction});
  if (random.count(0, 1) == 0)
    sim.system.colliders.push_back(
        {.shape = Sphere{.center = {0.0, 0.2, 0.0}, .radius = 0.2}, .restitution = restitution, .friction = friction});
  const int points = random.count(1, 8);
  std::vector<PointId> ids;
  for (int i = 0; i < points; ++i) {
    ids.push_back(sim.add(random.vector(0.2) + Vec3(0.0, 0.8, 0.0), random.power(-1.0, 0.0), random.vector(0.5)));
    sim.system.point(i).radius = 0.01;
    if (i > 0) {
      const double length = glm::distance(sim.state.position[i], sim.state.position[i - 1]);
      sim.join(ids[static_cast<std::size_t>(i) - 1], ids.back(), random.power(1.0, 3.0), length);
    }
  }
  return sim;
}

TestSim random_wind(Generator& random) {
  TestSim sim = random_cloth(random);
  const int n = static_cast<int>(std::lround(std::sqrt(sim.system.point_count())));
  const auto id = [&](int row, int column) { return sim.system.points()[row * n + column].id; };
  for (int row = 0; row + 1 < n; ++row)
    for (int column = 0; column + 1 < n; ++column) {
      sim.system.faces.push_back({{id(row, column), id(row, column + 1), id(row + 1, column)}});
      sim.system.faces.push_back({{id(row, column + 1), id(row + 1, column + 1), id(row + 1, column)}});
    }
  const ForceTerm& wind = *find_force_term("wind");
  sim.system.forces.push_back({.term = &wind, .values = default_values(wind)});
  return sim;
}

// A rope with a weight at its end that some springs do not carry.
TestSim random_break(Generator& random) {
  TestSim sim = random_rope(random);
  std::vector<Spring> springs = sim.system.springs();
  for (Spring& spring : springs)
    if (random.count(0, 3) == 0) spring.break_strain = random.number(0.05, 0.5);
  sim.system.set_springs(springs);
  return sim;
}

}  // namespace

RandomScene make_random_scene(unsigned long seed, int number) {
  Generator random(seed * 1'000'003ul + static_cast<unsigned long>(number));
  struct Kind {
    std::string_view name;
    TestSim (*make)(Generator&);
  };
  constexpr Kind kinds[] = {{"net", random_net},         {"rope", random_rope}, {"orbit", random_orbit},   {"cloth", random_cloth},
                            {"contact", random_contact}, {"wind", random_wind}, {"breaking", random_break}};
  const Kind& kind = kinds[static_cast<std::size_t>(number) % std::size(kinds)];
  RandomScene scene{.kind = kind.name, .sim = kind.make(random)};
  scene.tolerance = random.power(-4.5, -2.0);
  return scene;
}

}  // namespace hooke
