#include "batch/output_folder.h"

#include "base/atomic_write.h"
#include "base/errors.h"
#include "base/printable.h"

namespace hooke {
namespace {

[[noreturn]] void fail_to_create(const std::filesystem::path& folder, const std::error_code& reason) {
  throw FileError(printable(folder.native()) + ": cannot be created: " + reason.message());
}

}  // namespace

void make_folder(const std::filesystem::path& folder) {
  if (folder.empty()) fail_to_create(folder, std::make_error_code(std::errc::no_such_file_or_directory));
  std::filesystem::path part;
  // each part may be a link to a folder that does not exist yet
  for (const std::filesystem::path& name : folder) {
    part /= name;
    std::error_code missing, failure;
    if (std::filesystem::is_directory(part, missing)) continue;
    const std::filesystem::path target = follow_links(part, failure);
    if (!failure) std::filesystem::create_directories(target, failure);
    if (failure) fail_to_create(folder, failure);
  }
}

}  // namespace hooke
