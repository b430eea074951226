#include "cli/machine.h"

#include <algorithm>
#include <fstream>

#include "lab/printable.h"

namespace hooke {

std::string machine() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return printable(line.substr(std::min(line.size(), line.find(':') + 2)), 80);
  return "unknown";
}

}  // namespace hooke
