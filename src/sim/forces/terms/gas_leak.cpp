#include "sim/forces/terms/gas_leak.h"

#include "sim/forces/terms/rows.h"
#include "sim/portable_math.h"

namespace hooke {

void continue_leak(const Force& before, double time, Force& after) {
  if (before.term != &pressure_force || after.term != &pressure_force) return;
  constexpr std::size_t pressure = 0, leak = 3, start = 4;
  if (after.values[leak] == before.values[leak] || after.values[start] != before.values[start] || time <= before.values[start]) return;
  after.values[pressure] *= portable::exp(-before.values[leak] * (time - before.values[start]));
  after.values[start] = time;
}

}  // namespace hooke
