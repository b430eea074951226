// Elementary functions with the same bits on every machine, against the C library's in extended precision.
#include "sim/model/portable_math.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "support/random_scene.h"

namespace hooke {
namespace {

// The largest error [ulp] over random arguments.
template <class Function, class Exact>
double worst_error(Function function, Exact exact, double min, double max) {
  Random random(1);
  double worst = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    const double x = random.uniform(min, max);
    const long double expected = exact(static_cast<long double>(x));
    const double nearest = static_cast<double>(expected), ulp = std::abs(std::nextafter(nearest, INFINITY) - nearest);
    worst = std::max(worst, std::abs(static_cast<double>(static_cast<long double>(function(x)) - expected)) / ulp);
  }
  return worst;
}

TEST(PortableMath, IsAsExactAsDeclared) {
  using Extended = long double;
  EXPECT_LT(worst_error(
                portable::exp, [](Extended x) { return std::exp(x); }, -700.0, 700.0),
            1.0);
  EXPECT_LT(worst_error(
                portable::exp, [](Extended x) { return std::exp(x); }, -1.0, 1.0),
            1.0);
  EXPECT_LT(worst_error(
                portable::expm1, [](Extended x) { return std::expm1(x); }, -1.0, 1.0),
            4.0);
  EXPECT_LT(worst_error(
                portable::expm1, [](Extended x) { return std::expm1(x); }, -1e-8, 1e-8),
            1.0);
  EXPECT_LT(worst_error(
                portable::log, [](Extended x) { return std::log(x); }, 0.0, 10.0),
            1.0);
  EXPECT_LT(worst_error(
                portable::sin, [](Extended x) { return std::sin(x); }, -1e5, 1e5),
            1.0);
  EXPECT_LT(worst_error(
                portable::cos, [](Extended x) { return std::cos(x); }, -1e5, 1e5),
            1.0);
  for (const double y : {-3.0, -1.0, 2.0, 7.0})
    EXPECT_LT(worst_error([&](double x) { return portable::pow(x, y); }, [&](Extended x) { return std::pow(x, Extended(y)); }, 0.01, 10.0),
              6.0);
  EXPECT_LT(worst_error([](double x) { return portable::pow(x, -2.5); }, [](Extended x) { return std::pow(x, -2.5L); }, 0.1, 10.0),
            4.0 * (1.0 + 2.5 * std::log(10.0)));
}

TEST(PortableMath, AnglesAreExactInEveryQuadrant) {
  for (const double x : {-3.0, -1.0, -0.2, 0.2, 1.0, 3.0})
    EXPECT_LT(worst_error([&](double y) { return portable::atan2(y, x); },
                          [&](long double y) { return std::atan2(y, static_cast<long double>(x)); }, -4.0, 4.0),
              2.0)
        << x;
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(portable::atan2(0.0, 0.0), 0.0);
  EXPECT_EQ(portable::atan2(1.0, 0.0), std::atan2(1.0, 0.0));
  EXPECT_EQ(portable::atan2(-1.0, 0.0), -std::atan2(1.0, 0.0));
  EXPECT_EQ(portable::atan2(0.0, -1.0), std::acos(-1.0));
  EXPECT_EQ(portable::atan2(-0.0, -1.0), -std::acos(-1.0));
  EXPECT_EQ(portable::atan2(1e300, 1e-300), std::atan2(1.0, 0.0));
  EXPECT_TRUE(std::isnan(portable::atan2(infinity, 1.0)));
}

TEST(PortableMath, CoversTheEndsOfTheRange) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(portable::exp(0.0), 1.0);
  EXPECT_EQ(portable::exp(1000.0), infinity);
  EXPECT_EQ(portable::exp(-1000.0), 0.0);
  EXPECT_EQ(portable::expm1(-1000.0), -1.0);
  EXPECT_TRUE(std::isnan(portable::exp(std::nan(""))));
  EXPECT_EQ(portable::log(1.0), 0.0);
  EXPECT_EQ(portable::log(0.0), -infinity);
  EXPECT_TRUE(std::isnan(portable::log(-1.0)));
  EXPECT_EQ(portable::pow(2.0, -3.0), 0.125);
  EXPECT_EQ(portable::pow(0.0, -3.0), infinity);
  EXPECT_EQ(portable::sin(0.0), 0.0);
  EXPECT_EQ(portable::cos(0.0), 1.0);
  EXPECT_LE(std::abs(portable::sin(1e300)), 1.0);
  EXPECT_TRUE(std::isnan(portable::sin(infinity)));
}

// The bits of every function over many arguments. A machine or compiler with others fails here.
TEST(PortableMath, HasTheSameBitsOnEveryMachine) {
  Random random(7);
  std::uint64_t hash = 0;
  const auto add = [&](double value) { hash = (std::rotl(hash, 5) ^ std::bit_cast<std::uint64_t>(value)) * 0x9e3779b97f4a7c15ull; };
  for (int i = 0; i < 20'000; ++i) {
    const double x = random.uniform(-20.0, 20.0), positive = random.uniform(0.0, 20.0);
    for (const double value : {portable::exp(x), portable::expm1(x), portable::log(positive), portable::pow(positive, 0.1 * x),
                               portable::pow(positive, -3.0), portable::sin(100.0 * x), portable::cos(100.0 * x)})
      add(value);
  }
  EXPECT_EQ(hash, 0x484eb5df760ec775u) << std::hex << hash;
}

}  // namespace
}  // namespace hooke
