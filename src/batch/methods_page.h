// docs/reference/methods.md: every method, from its row in the table and its benchmark results.
#pragma once

#include <string>

#include "study/work_precision_file.h"

namespace hooke {

std::string methods_page(const Results& results);

}  // namespace hooke
