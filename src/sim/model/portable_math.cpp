// After fdlibm (Sun Microsystems, 1993: e_exp.c, e_log.c, k_sin.c, k_cos.c, e_rem_pio2.c, s_atan.c), whose coefficients and reductions are
// used. "Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Developed at SunPro, a Sun Microsystems, Inc. business.
// Permission to use, copy, modify, and distribute this software is freely granted, provided that this notice is preserved."
#include "sim/model/portable_math.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace hooke::portable {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10, inverse_ln2 = 1.44269504088896338700e+00;

// 2^k for -1022 <= k <= 1023
double power_of_two(int k) { return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52); }

// y 2^k; the result may be denormal or overflow.
double scale(double y, int k) {
  if (k > 1000) return y * power_of_two(1000) * power_of_two(k - 1000 < 1023 ? k - 1000 : 1023);
  if (k < -1000) return y * power_of_two(-1000) * power_of_two(k + 1000 > -1022 ? k + 1000 : -1022);
  return y * power_of_two(k);
}

// e^(high - low) - 1 for |high - low| <= ln 2 / 2
double small_expm1(double high, double low) {
  constexpr double p1 = 1.66666666666666019037e-01, p2 = -2.77777777770155933842e-03, p3 = 6.61375632143793436117e-05,
                   p4 = -1.65339022054652515390e-06, p5 = 4.13813679705723846039e-08;
  const double x = high - low, t = x * x;
  const double c = x - t * (p1 + t * (p2 + t * (p3 + t * (p4 + t * p5))));
  return (x * c / (2.0 - c) - low) + high;
}

// sin and cos of x + y for |x| <= pi / 4 and a small y
double kernel_sin(double x, double y) {
  constexpr double s1 = -1.66666666666666324348e-01, s2 = 8.33333333332248946124e-03, s3 = -1.98412698298579493134e-04,
                   s4 = 2.75573137070700676789e-06, s5 = -2.50507602534068634195e-08, s6 = 1.58969099521155010221e-10;
  const double z = x * x, v = z * x, r = s2 + z * (s3 + z * (s4 + z * (s5 + z * s6)));
  return x - ((z * (0.5 * y - v * r) - y) - v * s1);
}
double kernel_cos(double x, double y) {
  constexpr double c1 = 4.16666666666666019037e-02, c2 = -1.38888888888741095749e-03, c3 = 2.48015872894767294178e-05,
                   c4 = -2.75573143513906633035e-07, c5 = 2.08757232129817482790e-09, c6 = -1.13596475577881948265e-11;
  const double z = x * x, r = z * (c1 + z * (c2 + z * (c3 + z * (c4 + z * (c5 + z * c6)))));
  const double half = 0.5 * z, w = 1.0 - half;
  return w + (((1.0 - w) - half) + (z * r - x * y));
}

// x = quadrant pi / 2 + high + low
struct Reduced {
  int quadrant;
  double high, low;
};
Reduced reduce(double x) {
  constexpr double two_pi = 6.28318530717958647693, two_over_pi = 6.36619772367581382433e-01;
  // the first 33, the next 33 and the next 53 bits of pi / 2
  constexpr double pio2_1 = 1.57079632673412561417e+00, pio2_2 = 6.07710050630396597660e-11, pio2_2t = 2.02226624879595063154e-21;
  if (std::abs(x) > 1e5) x = std::fmod(x, two_pi);
  const double n = std::floor(x * two_over_pi + 0.5);
  const double first = x - n * pio2_1, second = n * pio2_2, rest = first - second;
  const double low = n * pio2_2t - ((first - rest) - second);
  const double high = rest - low;
  return {static_cast<int>(static_cast<std::int64_t>(n) & 3), high, (rest - high) - low};
}

// atan of x >= 0
double positive_atan(double x) {
  constexpr double a0 = 3.33333333333329318027e-01, a1 = -1.99999999998764832476e-01, a2 = 1.42857142725034663711e-01,
                   a3 = -1.11111104054623557880e-01, a4 = 9.09088713343650656196e-02, a5 = -7.69187620504482999495e-02,
                   a6 = 6.66107313738753120669e-02, a7 = -5.83357013379057348645e-02, a8 = 4.97687799461593236017e-02,
                   a9 = -3.65315727442169155270e-02, a10 = 1.62858201153657823623e-02;
  // x = tan(high + low + atan(rest))
  double high = 0.0, low = 0.0, rest = x;
  if (x >= 39.0 / 16.0) {
    high = 1.57079632679489655800e+00, low = 6.12323399573676603587e-17, rest = -1.0 / x;
  } else if (x >= 19.0 / 16.0) {
    high = 9.82793723247329054082e-01, low = 1.39033110312309984516e-17, rest = (x - 1.5) / (1.0 + 1.5 * x);
  } else if (x >= 11.0 / 16.0) {
    high = 7.85398163397448278999e-01, low = 3.06161699786838301793e-17, rest = (x - 1.0) / (x + 1.0);
  } else if (x >= 7.0 / 16.0) {
    high = 4.63647609000806093515e-01, low = 2.26987774529616870924e-17, rest = (2.0 * x - 1.0) / (2.0 + x);
  }
  const double z = rest * rest, w = z * z, even = z * (a0 + w * (a2 + w * (a4 + w * (a6 + w * (a8 + w * a10))))),
               odd = w * (a1 + w * (a3 + w * (a5 + w * (a7 + w * a9))));
  return high - ((rest * (even + odd) - low) - rest);
}

// x^n by repeated squaring
double whole_power(double x, int n) {
  double power = 1.0;
  for (; n > 0; n >>= 1) {
    if (n & 1) power *= x;
    x *= x;
  }
  return power;
}

}  // namespace

double exp(double x) {
  if (!(x <= 709.8)) return x > 0.0 ? infinity : x;
  if (x < -745.2) return 0.0;
  const double k = std::floor(x * inverse_ln2 + 0.5);
  return scale(1.0 + small_expm1(x - k * ln2_high, k * ln2_low), static_cast<int>(k));
}

double expm1(double x) { return std::abs(x) <= 0.34 ? small_expm1(x, 0.0) : exp(x) - 1.0; }

double log(double x) {
  constexpr double lg1 = 6.666666666666735130e-01, lg2 = 3.999999999940941908e-01, lg3 = 2.857142874366239149e-01,
                   lg4 = 2.222219843214978396e-01, lg5 = 1.818357216161805012e-01, lg6 = 1.531383769920937332e-01,
                   lg7 = 1.479819860511658591e-01;
  if (!(x > 0.0)) return x == 0.0 ? -infinity : std::numeric_limits<double>::quiet_NaN();
  if (x == infinity) return x;
  int k = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p54;
    k = -54;
  }
  // x = 2^k (1 + f), sqrt(1/2) < 1 + f <= sqrt(2)
  const auto bits = std::bit_cast<std::uint64_t>(x);
  double m = std::bit_cast<double>((bits & 0x000fffffffffffffu) | 0x3ff0000000000000u);
  k += static_cast<int>(bits >> 52) - 1023;
  if (m > 1.41421356237309504880) {
    m *= 0.5;
    ++k;
  }
  const double f = m - 1.0, s = f / (2.0 + f), z = s * s, w = z * z, half = 0.5 * f * f;
  const double r = w * (lg2 + w * (lg4 + w * lg6)) + z * (lg1 + w * (lg3 + w * (lg5 + w * lg7)));
  return k * ln2_high - ((half - (s * (half + r) + k * ln2_low)) - f);
}

double pow(double x, double y) {
  constexpr double max_whole = 8.0;
  if (y == std::floor(y) && std::abs(y) <= max_whole) {
    const double power = whole_power(x, static_cast<int>(std::abs(y)));
    return y < 0.0 ? 1.0 / power : power;
  }
  return exp(y * log(x));
}

double sin(double x) {
  if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
  const auto [quadrant, high, low] = reduce(x);
  const double value = quadrant % 2 == 0 ? kernel_sin(high, low) : kernel_cos(high, low);
  return quadrant < 2 ? value : -value;
}

double cos(double x) {
  if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
  const auto [quadrant, high, low] = reduce(x);
  const double value = quadrant % 2 == 0 ? kernel_cos(high, low) : kernel_sin(high, low);
  return quadrant == 0 || quadrant == 3 ? value : -value;
}

double atan2(double y, double x) {
  constexpr double pi = 3.14159265358979311600e+00, pi_low = 1.22464679914735317720e-16;
  if (!std::isfinite(x) || !std::isfinite(y)) return std::numeric_limits<double>::quiet_NaN();
  const double angle = x == 0.0 && y == 0.0 ? 0.0 : positive_atan(std::abs(y / x)), upper = x < 0.0 ? pi - (angle - pi_low) : angle;
  return std::signbit(y) ? -upper : upper;
}

}  // namespace hooke::portable
