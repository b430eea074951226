// The files of the font of the panels and of the stamps in pictures.
#pragma once

#include <filesystem>
#include <system_error>

namespace hooke {

// DejaVu Sans: fonts-dejavu-core of Debian, on which the package depends.
inline constexpr const char* fonts_folder = "/usr/share/fonts/truetype/dejavu";

// Without them letters are those of the font built into ImGui, and pictures differ.
inline bool has_font_files() {
  std::error_code error;
  const std::filesystem::path folder(fonts_folder);
  return std::filesystem::is_regular_file(folder / "DejaVuSans.ttf", error) &&
         std::filesystem::is_regular_file(folder / "DejaVuSans-Bold.ttf", error);
}

}  // namespace hooke
