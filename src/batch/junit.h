// Results of checks in the XML of JUnit, which CI systems show.
#pragma once

#include <string>
#include <vector>

namespace hooke {

struct JunitCase {
  std::string group, name;
  std::string failure;  // one line; empty: it passed
};

// One test suite of this name.
std::string format_junit(const std::string& name, const std::vector<JunitCase>& cases);

}  // namespace hooke
