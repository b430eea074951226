// Elementary functions whose bits do not depend on the C library or the machine: they use only operations that IEEE 754 rounds
// correctly. Within 1 ulp, except where noted.
#pragma once

namespace hooke::portable {

double exp(double x);
double expm1(double x);  // within 4 ulp
double log(double x);
// Within 6 ulp for whole exponents up to 8, else within 4 (1 + |y log x|) ulp. x must be positive.
double pow(double x, double y);
// Of huge arguments with the error that rounding 2 pi causes.
double sin(double x);
double cos(double x);
// Within 2 ulp; of (0, 0) 0, of what is not finite NaN.
double atan2(double y, double x);

}  // namespace hooke::portable
