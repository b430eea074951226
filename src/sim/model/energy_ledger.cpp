#include "sim/model/energy_ledger.h"

#include <algorithm>

namespace hooke {

double EnergyLedger::sum() const {
  double sum = 0.0;
  for (const double each : work) sum += each;
  return sum;
}

EnergyLedger& EnergyLedger::operator+=(const EnergyLedger& other) {
  for (std::size_t i = 0; i < causes; ++i) work[i] += other.work[i];
  return *this;
}

EnergyLedger& EnergyLedger::operator-=(const EnergyLedger& other) {
  for (std::size_t i = 0; i < causes; ++i) work[i] -= other.work[i];
  return *this;
}

EnergyLedger& EnergyLedger::operator*=(double factor) {
  for (double& each : work) each *= factor;
  return *this;
}

EnergyLedger explained(const EnergyLedger& frame, bool moves) {
  using enum EnergyCause;
  constexpr std::array only_take{StrainLimit, Drag, Dashpots, Contact};
  const auto may_supply = [&](EnergyCause cause) { return cause == StrainLimit && moves; };
  double supplied = 0.0, taken = 0.0;
  for (const EnergyCause cause : only_take)
    if (frame[cause] < 0.0 || !may_supply(cause)) (frame[cause] > 0.0 ? supplied : taken) += frame[cause];
  if (!(supplied > 0.0)) return frame;

  const double kept = taken < 0.0 ? std::max(0.0, 1.0 + supplied / taken) : 0.0;
  EnergyLedger result = frame;
  for (const EnergyCause cause : only_take) {
    if (frame[cause] < 0.0)
      result[cause] *= kept;
    else if (!may_supply(cause))
      result[cause] = 0.0;
  }
  return result;
}

}  // namespace hooke
