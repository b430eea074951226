#include "app/document/home.h"

#include <sys/stat.h>

#include <cstdlib>

namespace hooke {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const char* variable, const char* default_value) {
  const char* given = std::getenv(variable);
  if (given != nullptr && fs::path(given).is_absolute()) return fs::path(given) / "hooke";
  const char* home = std::getenv("HOME");
  return home != nullptr && fs::path(home).is_absolute() ? fs::path(home) / default_value / "hooke" : fs::path();
}

}  // namespace

Home xdg_home() { return {folder_of("XDG_CONFIG_HOME", ".config"), folder_of("XDG_STATE_HOME", ".local/state")}; }

bool make_private_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return true;
  if (folder.has_parent_path() && folder.parent_path() != folder && !make_private_folder(folder.parent_path())) return false;
  return ::mkdir(folder.c_str(), 0700) == 0 || fs::is_directory(folder, error);
}

}  // namespace hooke
