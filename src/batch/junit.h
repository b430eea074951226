// Results of checks in the XML of JUnit, which CI systems show.
#pragma once

#include <string>
#include <vector>

namespace hooke {

struct JunitCase {
  std::string group, name;
  std::string failure;  // one line; empty: it passed
};

// One test suite of this name. An interrupted run is a failure: what it did not reach is not known to pass.
std::string format_junit(const std::string& name, std::vector<JunitCase> cases, bool is_interrupted = false);

}  // namespace hooke
