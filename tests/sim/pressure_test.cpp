// The pressure of gas against closed forms: gradients, equilibria, energy. With HOOKE_PRINT set, the figures of docs/reference/pressure.md
// are printed.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "sim/forces/energy/energy.h"
#include "sim/forces/force_tangent.h"
#include "sim/forces/terms/gas_leak.h"
#include "sim/methods/rows.h"
#include "sim/step/divergence.h"
#include "support/gas_bodies.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

void displace(TestSim& sim, double size, std::uint64_t seed) {
  Random random(seed);
  const double z = sim.system.dimensions == 2 ? 0.0 : 1.0;
  for (Vec3& x : sim.state.position) x += size * Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), z * random.uniform(-1.0, 1.0));
}

// A ball and a ring, deformed at random.
std::vector<TestSim> deformed_bodies(const GasOptions& gas, double size = 0.1) {
  std::vector<TestSim> bodies{gas_ball(1, 50.0, gas), gas_ring(12, 50.0, gas)};
  for (TestSim& body : bodies) displace(body, size, 7);
  return bodies;
}

const GasOptions all_gases[] = {{.exponent = 0.0}, {}, {.exponent = 1.4}, {.exponent = 3.0}, {.exponent = 1.0, .ambient = 1e4}};

// ---- the force

TEST(Pressure, ForceIsMinusTheGradientOfThePotential) {
  for (const GasOptions& gas : all_gases)
    for (const TestSim& sim : deformed_bodies(gas)) {
      PackedGas packed(sim);
      const Field f = packed.force();
      for (std::size_t at = 0; at < f.size(); at += 5) {
        constexpr double step = 1e-5;
        double& x = packed.motion.x[at];
        const double start = x;
        x = start + step;
        const double above = packed.potential();
        x = start - step;
        const double below = packed.potential();
        x = start;
        EXPECT_NEAR(f[at], -(above - below) / (2.0 * step), 1e-7 * length_of(f)) << gas.exponent << ' ' << at;
      }
    }
}

TEST(Pressure, ForcesConserveMomentumAndAngularMomentumFarFromTheOrigin) {
  for (TestSim& sim : deformed_bodies({}, 0.5)) {
    for (Vec3& x : sim.state.position) x += Vec3(30.0, -20.0, 0.0);
    const PackedGas packed(sim);
    const Field f = packed.force();
    Vec3 sum(0.0), torque(0.0);
    for (Index i = 0; i < packed.plan.points; ++i) {
      sum += vector_at(packed.plan, f, i);
      torque += glm::cross(sim.state.position[i] - sim.state.position[0], vector_at(packed.plan, f, i));
    }
    EXPECT_GT(length_of(f), 10.0);
    EXPECT_LT(glm::length(sum), 1e-14 * length_of(f));
    EXPECT_LT(glm::length(torque), 1e-13 * length_of(f));
  }
}

TEST(Pressure, TheMatrixOfImplicitMethodsIsTheDerivativeOfTheForce) {
  for (const GasOptions& gas : all_gases)
    for (const TestSim& sim : deformed_bodies(gas)) {
      const PackedGas packed(sim);
      const Plan& plan = packed.plan;
      ForceTangent tangent;
      tangent.reset(plan);
      pressure_force.add_tangent(plan, packed.values(), 0.0, packed.motion.x.data(), packed.motion.v.data(), tangent);
      Random random(3);
      Field u(packed.motion.x.size()), plus = packed.motion.x, minus = packed.motion.x;
      constexpr double step = 1e-5;
      for (std::size_t at = 0; at < u.size(); ++at) {
        u[at] = random.uniform(-1.0, 1.0);
        plus[at] += step * u[at];
        minus[at] -= step * u[at];
      }
      Field product(u.size(), 0.0);
      for (std::size_t e = 0; e < plan.force_data.enclosures.edges.size(); ++e) {
        const auto& [i, j] = plan.force_data.enclosures.edges[e];
        const Vec3 w = tangent.volume_curvature(e), first = glm::cross(w, vector_at(plan, u, j)),
                   second = -glm::cross(w, vector_at(plan, u, i));
        for (int c = 0; c < plan.dimensions; ++c) {
          product[static_cast<std::size_t>(c) * plan.points + i] += first[c];
          product[static_cast<std::size_t>(c) * plan.points + j] += second[c];
        }
      }
      const ForceTangent::Volume& volume = tangent.volume(0);
      double projection = 0.0;
      for (std::size_t at = 0; at < u.size() && volume.stiffness > 0.0; ++at) projection += volume.gradient[at] * u[at];
      const Field above = packed.force_at(plus), below = packed.force_at(minus);
      const double size = length_of(product) + volume.stiffness * std::abs(projection) * length_of(volume.gradient);
      ASSERT_GT(size, 1.0);
      for (std::size_t at = 0; at < u.size(); ++at)
        EXPECT_NEAR(product[at] + volume.stiffness * projection * volume.gradient[at], -(above[at] - below[at]) / (2.0 * step), 1e-7 * size)
            << gas.exponent << ' ' << at;
    }
}

// The largest absolute eigenvalue of M^-1/2 (df/dx) M^-1/2.
double largest_stiffness(const TestSim& sim) {
  const PackedGas packed(sim);
  const auto size = static_cast<Eigen::Index>(packed.motion.x.size());
  Eigen::MatrixXd matrix(size, size);
  const auto root = [&](Eigen::Index at) { return std::sqrt(packed.plan.inverse_mass[static_cast<std::size_t>(at) % packed.plan.points]); };
  for (Eigen::Index column = 0; column < size; ++column) {
    constexpr double step = 1e-5;
    Field plus = packed.motion.x, minus = packed.motion.x;
    plus[column] += step;
    minus[column] -= step;
    const Field above = packed.force_at(plus), below = packed.force_at(minus);
    for (Eigen::Index row = 0; row < size; ++row) matrix(row, column) = (above[row] - below[row]) / (2.0 * step) * root(row) * root(column);
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (matrix + matrix.transpose())).eigenvalues().cwiseAbs().maxCoeff();
}

TEST(Pressure, AConstantOneInAFlatSceneHasABoundForEveryShape) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    TestSim sim = gas_ring(5 + static_cast<int>(seed), 50.0, {.exponent = 0.0});
    Random random(seed);
    for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).mass *= random.uniform(0.2, 2.0);
    sim.system.point(2).nailed = seed % 2 == 0;
    displace(sim, seed % 3 == 0 ? 5.0 : 0.2, seed);
    const ForceBound bound = pressure_force.bound(sim.system, make_plan(sim.system), sim.system.forces[0].values, 0.0);
    const double largest = largest_stiffness(sim);
    EXPECT_GE(bound.stiffness, largest * (1.0 - 1e-6)) << seed;
    EXPECT_LE(bound.stiffness, 5.0 * largest) << seed;
  }
}

TEST(Pressure, OtherwiseTheEstimateHoldsForSurfacesThatAreNotStretched) {
  for (const GasOptions& gas : {GasOptions{}, {.exponent = 1.4}, {.ambient = 1e4}})
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      TestSim sim = seed % 2 == 0 ? gas_ball(1, 50.0, gas) : gas_ring(16, 50.0, gas);
      Random random(seed);
      for (Vec3& x : sim.state.position) {
        const double strain = seed < 2 ? 0.0 : random.uniform(-0.1, 0.0);
        x *= 1.0 + strain;
        if (seed >= 4) x.y *= 0.8;
      }
      const ForceBound bound = pressure_force.bound(sim.system, make_plan(sim.system), sim.system.forces[0].values, 0.0);
      EXPECT_EQ(bound.stiffness, ForceBound::none);
      const double largest = largest_stiffness(sim);
      EXPECT_GE(bound.estimated_stiffness, largest) << seed;
      EXPECT_LE(bound.estimated_stiffness, 10.0 * largest) << seed;
      // the part that implicit methods may leave out, of a gas without the other part
      TestSim constant = sim;
      constant.system.forces[0].values[1] = 0.0;
      constant.system.forces[0].values[0] *= PackedGas(sim).plan.force_data.enclosures.enclosures[0].full_volume / PackedGas(sim).volume();
      EXPECT_GE(bound.omitted_stiffness, largest_stiffness(constant) * (gas.exponent == 1.0 && gas.ambient == 0.0 ? 1.0 : 0.0)) << seed;
    }
}

TEST(Pressure, WithoutAClosedSurfaceThereIsNoForceAndTheStiffnessIsBounded) {
  TestSim sim = gas_ball(1, 50.0, {});
  sim.system.faces.pop_back();
  EXPECT_EQ(length_of(PackedGas(sim).force()), 0.0);
  const Spectrum spectrum = bound_spectrum(sim.system);
  EXPECT_TRUE(spectrum.is_bounded);
  EXPECT_EQ(spectrum.estimated_omega, 0.0);
}

// ---- the law

// [Pa], from the force.
double pressure_of(const PackedGas& packed, double time = 0.0) {
  const Field f = packed.force(time);
  Field gradient(f.size(), 0.0);
  add_volume_gradient(packed.plan, packed.plan.force_data.enclosures.enclosures[0], 1.0, packed.motion.x.data(), gradient.data());
  return length_of(f) / length_of(gradient);
}

TEST(Pressure, FollowsThePolytropicLaw) {
  for (const double exponent : {0.0, 0.5, 1.0, 1.4, 3.0})
    for (const double scale : {0.6, 1.0, 1.7}) {
      TestSim sim = gas_ball(1, 50.0, {.pressure = 200.0, .exponent = exponent});
      for (Vec3& x : sim.state.position) x *= scale;
      const PackedGas packed(sim);
      const double ratio = packed.volume() / packed.plan.force_data.enclosures.enclosures[0].full_volume;
      EXPECT_NEAR(pressure_of(packed), 200.0 * std::pow(ratio, -exponent), 1e-11) << exponent << ' ' << scale;
    }
}

TEST(Pressure, ActsAgainstTheAmbientPressure) {
  TestSim sim = gas_ring(12, 50.0, {.pressure = 200.0, .ambient = 1e5});
  const double full = PackedGas(sim).plan.force_data.enclosures.enclosures[0].full_volume;
  for (const double ratio : {0.8, 1.0, 1.001}) {
    TestSim scaled = sim;
    for (Vec3& x : scaled.state.position) x *= std::sqrt(ratio * full / PackedGas(sim).volume());
    EXPECT_NEAR(pressure_of(PackedGas(scaled)), 1.002e5 / ratio - 1e5, 1e-8) << ratio;
  }
}

TEST(Pressure, ALeakIsExponentialFromItsStart) {
  const TestSim sim = gas_ball(1, 50.0, {.leak = 0.3, .leak_start = 2.0});
  const PackedGas packed(sim);
  const double full = pressure_of(packed, 0.0);
  EXPECT_EQ(pressure_of(packed, 2.0), full);
  for (const double time : {2.5, 5.0, 30.0}) EXPECT_NEAR(pressure_of(packed, time), full * std::exp(-0.3 * (time - 2.0)), 1e-12 * full);
}

// As the leak of a bicycle tube that is widened, or mended: the amount of gas is continuous.
TEST(Pressure, ALeakThatIsChangedLeavesWhatHasLeaked) {
  for (const double leak : {0.0, 0.1, 0.7})
    for (const double changed_to : {0.0, 0.2, 2.0}) {
      TestSim sim = gas_ball(1, 50.0, {.leak = leak, .leak_start = 2.0});
      const Force before = sim.system.forces[0];
      const double left = pressure_of(PackedGas(sim), 5.0);
      Force& force = sim.system.forces[0];
      force.values[3] = changed_to;
      continue_leak(before, 5.0, force);
      EXPECT_NEAR(pressure_of(PackedGas(sim), 5.0), left, 1e-12 * left) << leak << ' ' << changed_to;
      EXPECT_NEAR(pressure_of(PackedGas(sim), 8.0), left * std::exp(-3.0 * changed_to), 1e-12 * left) << leak << ' ' << changed_to;
    }
}

TEST(Pressure, ALeakThatIsChangedBeforeItsStartStartsThen) {
  const Force before = gas_force({.leak = 0.3, .leak_start = 2.0});
  Force after = gas_force({.leak = 0.5, .leak_start = 2.0});
  continue_leak(before, 1.0, after);
  EXPECT_EQ(after, gas_force({.leak = 0.5, .leak_start = 2.0}));
  after.values[4] = 3.0;
  continue_leak(before, 5.0, after);
  EXPECT_EQ(after, gas_force({.leak = 0.5, .leak_start = 3.0}));
}

TEST(Pressure, ALeakEndsAtTheAmbientPressureInTheFullVolume) {
  TestSim sim = gas_ring(12, 50.0, {.pressure = 200.0, .ambient = 1e3, .leak = 1.0});
  const double scale = std::sqrt(PackedGas(sim).plan.force_data.enclosures.enclosures[0].full_volume / PackedGas(sim).volume());
  for (Vec3& x : sim.state.position) x *= scale;
  EXPECT_NEAR(pressure_of(PackedGas(sim), 100.0), 0.0, 1e-10);
}

TEST(Pressure, IsFiniteWithoutVolumeAndInsideOut) {
  for (const double y : {0.0, 1e-9, -1e-9, 0.01, -1.0}) {
    TestSim sim = gas_ball(1, 50.0, {});
    for (Vec3& x : sim.state.position) x.y *= y;
    const PackedGas packed(sim);
    const Field f = packed.force();
    for (const double component : f) ASSERT_TRUE(std::isfinite(component)) << y;
    if (y != -1.0) {
      EXPECT_NEAR(pressure_of(packed), 100.0 * 20.0, 1e-9) << y;  // that at a twentieth of the full volume
    }
    // outwards
    double outward = 0.0;
    for (Index i = 0; i < packed.plan.points; ++i) outward += glm::dot(vector_at(packed.plan, f, i), sim.state.position[i]);
    EXPECT_GE(outward, 0.0) << y;
    EXPECT_TRUE(std::isfinite(packed.potential())) << y;
  }
}

// ---- equilibria

// Brings it to rest.
void settle(TestSim& sim) {
  for (const double h : {0.01, 0.1, 1.0}) sim.run(implicit_euler, 60.0 * h, 60);
}

// The value between both at which an increasing function is zero.
template <class F>
double root_of(const F& function, double low, double high) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (function(middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// The tension T = k (l - l0) of the springs of a polygon of the circumradius R is p R cos(pi / n).
TEST(Pressure, ARingHasTheRadiusOfItsClosedForm) {
  for (const int n : {5, 12, 40})
    for (const GasOptions& gas : {GasOptions{}, {.pressure = 30.0, .exponent = 0.0}, {.ambient = 1e3}}) {
      TestSim sim = gas_ring(n, 10.0 * n, gas);
      settle(sim);
      const double l0 = 2.0 * std::sin(gas_pi / n), full = n * l0 * n * l0 / (4.0 * gas_pi);
      const double radius = root_of(
          [&](double r) {
            const double area = 0.5 * n * r * r * std::sin(2.0 * gas_pi / n);
            const double p = (gas.pressure + gas.ambient) * std::pow(full / area, gas.exponent) - gas.ambient;
            return 10.0 * n * (2.0 * r * std::sin(gas_pi / n) - l0) - p * r * std::cos(gas_pi / n);
          },
          0.5, 4.0);
      EXPECT_GT(radius, 1.01);
      for (const Vec3& x : sim.state.position) EXPECT_NEAR(glm::length(x), radius, 1e-9) << n;
    }
}

// Of an icosahedron of the edge l, T = p V / (10 l), V = 5/12 (3 + sqrt 5) l^3.
TEST(Pressure, AnIcosahedronHasTheRadiusOfItsClosedForm) {
  for (const GasOptions& gas : {GasOptions{}, {.pressure = 40.0, .exponent = 0.0}, {.exponent = 1.4, .ambient = 1e3}}) {
    TestSim sim = gas_ball(0, 60.0, gas);
    const double l0 = sim.system.springs()[0].rest_length, shape = 5.0 / 12.0 * (3.0 + std::sqrt(5.0));
    const double full = PackedGas(sim).plan.force_data.enclosures.enclosures[0].full_volume;
    settle(sim);
    const double edge = root_of(
        [&](double l) {
          const double volume = shape * l * l * l, p = (gas.pressure + gas.ambient) * std::pow(full / volume, gas.exponent) - gas.ambient;
          return 60.0 * (l - l0) - p * volume / (10.0 * l);
        },
        0.5 * l0, 4.0 * l0);
    EXPECT_GT(edge, 1.01 * l0);
    for (const Vec3& x : sim.state.position) EXPECT_NEAR(glm::length(x), edge / l0, 1e-9);
  }
}

// Of any shape, the sum of the tensions times the lengths is 3 p V (2 p A in flat scenes): the virial of forces at rest.
TEST(Pressure, ABallAtRestHasTheVirialOfItsGasAndNearlyTheRadiusOfASphere) {
  TestSim sim = gas_ball(2, 60.0, {});
  settle(sim);
  double virial = 0.0, stress = 0.0;
  for (const Spring& spring : sim.system.springs()) {
    const double length = glm::distance(sim.position(spring.first), sim.position(spring.second));
    virial += spring.stiffness * (length - spring.rest_length) * length;
    stress += length;
  }
  const PackedGas packed(sim);
  EXPECT_NEAR(virial, 3.0 * pressure_of(packed) * packed.volume(), 1e-9 * virial);
  double min = 1e9, max = 0.0;
  for (const Vec3& x : sim.state.position) {
    min = std::min(min, glm::length(x));
    max = std::max(max, glm::length(x));
  }
  if (std::getenv("HOOKE_PRINT") != nullptr) std::printf("ball of 162 points: radius %.6f to %.6f\n", min, max);
  EXPECT_LT(max / min, 1.02);
}

// ---- energy

// A ball and a ring that are deformed and vibrate.
double energy_error(bool is_ball, const GasOptions& gas, int steps) {
  TestSim sim = is_ball ? gas_ball(1, 50.0, gas) : gas_ring(16, 50.0, gas);
  for (Vec3& x : sim.state.position) x.y *= 0.9;
  const auto energy = [&] { return compute_energy(sim.system, sim.state).total() + PackedGas(sim).potential(); };
  const double before = energy(), scale = (gas.pressure + gas.ambient) * PackedGas(sim).volume();
  sim.run(velocity_verlet, 0.3, steps);
  return (energy() - before) / scale;
}

TEST(Pressure, EnergyIsConservedToSecondOrderByVerlet) {
  for (const bool is_ball : {false, true})
    for (const GasOptions& gas : {GasOptions{}, {.exponent = 1.4, .ambient = 1e3}}) {
      const double coarse = energy_error(is_ball, gas, 400), fine = energy_error(is_ball, gas, 800);
      EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1) << is_ball;
      EXPECT_LT(std::abs(fine), 1e-4) << is_ball;
    }
}

TEST(Pressure, TheLedgerAccountsForTheWorkOfTheGasWithAndWithoutALeak) {
  for (const bool is_ball : {false, true})
    for (const double leak : {0.0, 2.0}) {
      const GasOptions gas{.leak = leak};
      TestSim sim = is_ball ? gas_ball(1, 50.0, gas) : gas_ring(16, 50.0, gas);
      for (Vec3& x : sim.state.position) x *= 0.8;
      initialize_supply(sim.system, sim.state);
      double supplied = 0.0;
      for (int frame = 0; frame < 30; ++frame) {
        const double before = sim.state.supply.net_input;
        sim.run(velocity_verlet, 1.0 / 60.0, 100);
        supplied += std::abs(sim.state.supply.net_input - before);
      }
      ASSERT_GT(supplied, 10.0);
      EXPECT_NEAR(compute_energy(sim.system, sim.state).total(), sim.state.supply.net_input, 1e-4 * supplied) << is_ball << ' ' << leak;
    }
}

}  // namespace
}  // namespace hooke
