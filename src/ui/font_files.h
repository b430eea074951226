// The files of the font of the panels and of the stamps in pictures.
#pragma once

#include <filesystem>
#include <system_error>

#include "formats/scene_file.h"

namespace hooke {

// DejaVu Sans, shipped beside the scenes, so that pictures do not depend on the fonts of the machine. The Debian package depends on
// fonts-dejavu-core, which has the same files. Empty: neither is there, and letters are those of the font built into ImGui.
inline std::filesystem::path font_file(const char* name) {
  std::error_code error;
  for (const std::filesystem::path& folder : {assets_folder() / "fonts", std::filesystem::path("/usr/share/fonts/truetype/dejavu")})
    if (std::filesystem::is_regular_file(folder / name, error)) return folder / name;
  return {};
}

// Chinese, Japanese and Korean, of the package fonts-noto-cjk; empty: it is not installed.
inline std::filesystem::path cjk_font_file() {
  const std::filesystem::path file = "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc";
  std::error_code error;
  return std::filesystem::is_regular_file(file, error) ? file : std::filesystem::path();
}

}  // namespace hooke
