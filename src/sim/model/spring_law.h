// The force of a spring that is not f = -k (l - l0), or whose rest length changes with time.
#pragma once

#include <cstdint>
#include <limits>

namespace hooke {

enum class SpringForce : std::uint8_t {
  Linear,  // T = k e, e = l - l0
  Cable,   // the same where e > 0, else no force, nor that of the dashpot
  Strut,   // the same where e < 0, else no force, nor that of the dashpot
  Cubic,   // T = k e + k3 e^3; with k3 < 0 up to its largest value, which it keeps
};

struct SpringLaw {
  SpringForce force = SpringForce::Linear;
  double k3 = 0.0;  // [N/m^3], of the cubic force
  // The rest length follows (l0 + rate t within its limits) (1 + amplitude sin(2 pi frequency t + phase)), t the time of the muscles.
  double amplitude = 0.0;                                            // [1], -1..1
  double frequency = 1.0;                                            // [1/s], >= 0
  double phase = 0.0;                                                // [rad]
  double rate = 0.0;                                                 // [m/s]
  double min_rest_length = 0.0;                                      // [m], >= 0
  double max_rest_length = std::numeric_limits<double>::infinity();  // [m], >= the minimum
  bool moves() const { return amplitude != 0.0 || rate != 0.0; }
  // [s], the longest that resolves its oscillation, where the time of the muscles passes this fast; infinity: it does not oscillate
  double resolving_step(double speed) const;
  bool operator==(const SpringLaw&) const = default;
};

// Of a spring at its length.
struct SpringResponse {
  double tension = 0.0;    // [N], > 0 pulls the ends together
  double stiffness = 0.0;  // [N/m], its derivative with respect to the length
  double energy = 0.0;     // [J]
  bool acts = false;       // whether its dashpot does
};
SpringResponse response_of(const SpringLaw& law, double stiffness, double extension);

// [N/m], the largest derivative up to 100 % strain.
double max_stiffness(const SpringLaw& law, double stiffness, double rest_length);

// The rest length at a time of the muscles, and its rate of change.
struct MovingLength {
  double length = 0.0;  // [m]
  double rate = 0.0;    // [m/s]
};
MovingLength rest_length_at(const SpringLaw& law, double rest_length, double time);

// The time of all muscles and winches: offset + speed t. Whoever changes the speed changes the offset too, so that nothing jumps.
struct MuscleClock {
  bool on = true;
  double speed = 1.0;   // [1], >= 0
  double offset = 0.0;  // [s]
  double rate() const { return on ? speed : 0.0; }
  double at(double time) const { return offset + rate() * time; }
  bool operator==(const MuscleClock&) const = default;
};

}  // namespace hooke
