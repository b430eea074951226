#include "base/own_library.h"

#include <dlfcn.h>
#include <link.h>

#include <system_error>

namespace hooke {

std::filesystem::path own_library() {
  static const int here = 0;
  Dl_info info{};
  link_map* map = nullptr;
  if (dladdr1(&here, &info, reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) == 0 || map == nullptr) return {};
  // the name of a program is empty
  std::error_code error;
  return map->l_name[0] == '\0' ? std::filesystem::path() : std::filesystem::canonical(map->l_name, error);
}

}  // namespace hooke
