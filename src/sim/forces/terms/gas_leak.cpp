#include "sim/forces/terms/gas_leak.h"

#include "sim/forces/terms/rows.h"
#include "sim/model/portable_math.h"

namespace hooke {

namespace {

constexpr std::size_t pressure_value = 0, leak_value = 3, start_value = 4;

bool are_gases(const Force& one, const Force& other) { return one.term == &pressure_force && other.term == &pressure_force; }

}  // namespace

void continue_leak(const Force& before, double time, Force& after) {
  if (!are_gases(before, after)) return;
  if (after.values[leak_value] == before.values[leak_value] || after.values[start_value] != before.values[start_value] ||
      time <= before.values[start_value])
    return;
  after.values[pressure_value] *= portable::exp(-before.values[leak_value] * (time - before.values[start_value]));
  after.values[start_value] = time;
}

bool is_leak_continued(const Force& before, const Force& after) {
  return are_gases(before, after) && after.values[leak_value] != before.values[leak_value] &&
         after.values[start_value] > before.values[start_value];
}

Force before_leaks(const Force& now, double time, std::span<const LeakChange> changes) {
  Force earlier = now;
  for (std::size_t i = changes.size(); i-- > 0;) {
    const auto& [before, after] = changes[i];
    if (!are_gases(after, earlier) || after.values[start_value] <= time || after.values[start_value] != earlier.values[start_value])
      continue;
    // a pressure that was changed since then stays
    if (earlier.values[pressure_value] == after.values[pressure_value]) earlier.values[pressure_value] = before.values[pressure_value];
    earlier.values[leak_value] = before.values[leak_value];
    earlier.values[start_value] = before.values[start_value];
  }
  Force result = now;
  result.values[pressure_value] = earlier.values[pressure_value];
  result.values[start_value] = earlier.values[start_value];
  continue_leak(earlier, time, result);
  return result;
}

}  // namespace hooke
