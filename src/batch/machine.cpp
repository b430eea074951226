#include "batch/machine.h"

#include <algorithm>
#include <ctime>
#include <fstream>

#include "base/printable.h"

namespace hooke {

std::string machine() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return printable(line.substr(std::min(line.size(), line.find(':') + 2)), 80);
  return "unknown";
}

std::string time_text(const char* format) {
  const std::time_t time = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&time, &utc);
  char text[64];
  std::strftime(text, sizeof text, format, &utc);
  return text;
}

}  // namespace hooke
