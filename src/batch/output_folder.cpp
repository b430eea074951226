#include "batch/output_folder.h"

#include "base/errors.h"
#include "base/printable.h"

namespace hooke {

void make_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw FileError(printable(folder.native()) + ": cannot be created: " + failure.message());
}

}  // namespace hooke
