#include "batch/check.h"

#include <algorithm>
#include <thread>

#include "base/errors.h"
#include "base/option_error.h"
#include "base/printable.h"
#include "base/text_lines.h"
#include "batch/bench.h"
#include "formats/scene_file.h"
#include "sim/control/automatic.h"

namespace hooke {

std::vector<std::string> shipped_scene_ids() {
  std::vector<std::string> ids;
  for (const ShippedScene& shipped : shipped_scenes()) ids.push_back(shipped.id);
  if (ids.empty()) throw FileError(printable((assets_folder() / "scenes").native()) + ": no scenes found");
  return ids;
}

std::vector<const HardCase*> chosen_cases(const std::vector<int>& numbers) {
  std::vector<const HardCase*> chosen;
  for (const HardCase& row : hard_cases())
    if (numbers.empty() || std::ranges::find(numbers, row.number) != numbers.end()) chosen.push_back(&row);
  const std::string known = joined(hard_cases(), [](const HardCase& row) { return std::to_string(row.number); });
  for (const int number : numbers)
    if (std::ranges::find(chosen, number, &HardCase::number) == chosen.end())
      throw OptionError("cases", std::to_string(number), "no such case: must be one of " + known);
  return chosen;
}

std::vector<const Integrator*> methods_for_cases(const std::vector<std::string>& ids, bool quick) {
  std::vector<const Integrator*> methods = chosen_methods(ids);
  if (ids.empty() && !quick) methods.push_back(&automatic_method());
  return methods;
}

int default_threads() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

}  // namespace hooke
