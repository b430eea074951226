// Numbers and quantities as the window shows them.
#include "base/number_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hooke {
namespace {

TEST(NumberText, HasFourDigitsAndAllOfALargeInteger) {
  EXPECT_EQ(number_text(0.0), "0");
  EXPECT_EQ(number_text(-0.0), "0");
  EXPECT_EQ(number_text(1.0 / 6.0), "0.1667");
  EXPECT_EQ(number_text(-12.345), "-12.35");
  EXPECT_EQ(number_text(1000.0), "1000");
  EXPECT_EQ(number_text(9999.7), "10,000");
  EXPECT_EQ(number_text(150512.4), "150,512");
  EXPECT_EQ(number_text(-1234567.0), "-1,234,567");
  EXPECT_EQ(number_text(12345.67, 6), "12,345.7");
  EXPECT_EQ(number_text(123.0, 2), "123");
  EXPECT_EQ(number_text(0.0123, 1), "0.01");
}

TEST(NumberText, IsAPowerOfTenWhereDigitsWouldBeZeros) {
  EXPECT_EQ(number_text(2.5e-5), "2.5\u00d710\u207b\u2075");
  EXPECT_EQ(number_text(-1.2345678e12), "-1.235\u00d710\u00b9\u00b2");
  EXPECT_EQ(number_text(1e300), "1\u00d710\u00b3\u2070\u2070");
}

TEST(NumberText, NeverHasTheExponentOfAProgrammingLanguage) {
  for (int digits = 1; digits <= 6; ++digits)
    for (double value = 1e-20; value < 1e20; value *= 1.37) {
      EXPECT_EQ(number_text(value, digits).find('e'), std::string::npos) << value;
      EXPECT_EQ(quantity_text(-value, "J", digits).find('e'), std::string::npos) << value;
      EXPECT_EQ(quantity_text(value, "kg m/s", digits).find('e'), std::string::npos) << value;
    }
}

TEST(QuantityText, HasPrefixes) {
  EXPECT_EQ(quantity_text(1.505e5, "J"), "150.5 kJ");
  EXPECT_EQ(quantity_text(-2.5e7, "J"), "-25 MJ");
  EXPECT_EQ(quantity_text(0.25, "m"), "0.25 m");
  EXPECT_EQ(quantity_text(9999.0, "m"), "9999 m");
  EXPECT_EQ(quantity_text(1.2e-5, "m"), "12 \u03bcm");
  EXPECT_EQ(quantity_text(0.001, "s"), "1 ms");
  EXPECT_EQ(quantity_text(0.0, "J"), "0 J");
  EXPECT_EQ(quantity_text(2e6, "N/m"), "2 MN/m");
}

// A prefix of "kg" would be wrong, and kiloseconds are not used.
TEST(QuantityText, OfOtherUnitsIsAPowerOfTen) {
  EXPECT_EQ(quantity_text(2.5e-7, "kg m/s"), "2.5\u00d710\u207b\u2077 kg m/s");
  EXPECT_EQ(quantity_text(86400.0, "s"), "86,400 s");
  EXPECT_EQ(quantity_text(1e20, "J"), "1\u00d710\u00b2\u2070 J");
  EXPECT_EQ(quantity_text(1e-5, "1"), "1\u00d710\u207b\u2075");
}

TEST(UnitText, HasSuperscripts) {
  EXPECT_EQ(unit_text("kg m^2/s"), "kg m\u00b2/s");
  EXPECT_EQ(unit_text("kg/m^3"), "kg/m\u00b3");
  EXPECT_EQ(quantity_text(9.81, "m/s^2"), "9.81 m/s\u00b2");
}

TEST(QuantityText, IsTheValueWithinItsDigits) {
  for (double value = 1e-17; value < 1e13; value *= 1.7) {
    const UnitScale scale = unit_scale(value, "J");
    EXPECT_GE(value / scale.factor, 0.01);
    EXPECT_LT(value / scale.factor, 1e4);
    if (value >= 1e-14 && value < 1e12) {
      EXPECT_TRUE(quantity_text(value, "J").ends_with(scale.unit)) << value;
    }
  }
  EXPECT_EQ(unit_scale(1.505e5, "J").unit, "kJ");
  EXPECT_EQ(unit_scale(2e-7, "kg m/s").unit, "10\u207b\u2079 kg m/s");
  EXPECT_EQ(unit_scale(INFINITY, "J").factor, 1.0);
}

}  // namespace
}  // namespace hooke
