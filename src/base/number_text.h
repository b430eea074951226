// Numbers and quantities as people read them: no exponents such as "1.505e+05".
#pragma once

#include <string>
#include <string_view>

namespace hooke {

// So many significant digits, and all digits of an integer part below ten million, in groups from five digits on: "0.1667", "1234",
// "123,456"; a power of ten for numbers beyond 1e-4 and 1e7: "2.5×10⁻⁵".
std::string number_text(double value, int digits = 4);

// "m/s²" for "m/s^2", "kg/m³" for "kg/m^3".
std::string unit_text(std::string_view unit);

// A unit in which a number of this size is short.
struct UnitScale {
  double factor;     // of the unit that was given
  std::string unit;  // "kJ"; "10³ kg m/s" for a unit that has no prefixes
};
// The unit itself for sizes from 0.01 to 10,000.
UnitScale unit_scale(double size, std::string_view unit);

// With an SI prefix where the number would be long or small: "150.5 kJ", "12 μm", "0.25 m". Only the unit's first letter gets one: "2
// kN/m".
std::string quantity_text(double value, std::string_view unit, int digits = 4);

}  // namespace hooke
