#include "ui/theme.h"

#include <imgui_freetype.h>

#include <filesystem>

namespace hooke {
namespace {

// Of the current context; ImGui keeps its own state the same way.
Fonts current_fonts;
double current_scale = 1.0;

// Latin, Greek and Cyrillic for names; punctuation, arrows and signs for the panels' own words.
constexpr ImWchar glyphs[] = {0x0020, 0x017f, 0x0370, 0x03ff, 0x0400, 0x04ff, 0x2010, 0x2027,
                              0x2070, 0x209f, 0x2190, 0x2193, 0x2200, 0x2265, 0};

ImFont* load_font(const char* name, double size, double density) {
  ImGuiIO& io = ImGui::GetIO();
  const std::filesystem::path file = std::filesystem::path("/usr/share/fonts/truetype/dejavu") / name;
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error))
    if (ImFont* font = io.Fonts->AddFontFromFileTTF(file.c_str(), static_cast<float>(size * density), nullptr, glyphs)) return font;
  ImFontConfig config;
  config.SizePixels = static_cast<float>(size * density);
  return io.Fonts->AddFontDefault(&config);
}

ImVec4 color(ImU32 packed) { return ImGui::ColorConvertU32ToFloat4(packed); }

void set_colors(ImVec4* colors) {
  using namespace palette;
  const std::pair<ImGuiCol, ImU32> rows[] = {
      {ImGuiCol_Text, text},
      {ImGuiCol_TextDisabled, dim},
      {ImGuiCol_WindowBg, panel},
      {ImGuiCol_ChildBg, panel},
      {ImGuiCol_PopupBg, box},
      {ImGuiCol_MenuBarBg, panel},
      {ImGuiCol_Border, edge},
      {ImGuiCol_Separator, line},
      {ImGuiCol_FrameBg, raised},
      {ImGuiCol_FrameBgHovered, hovered},
      {ImGuiCol_FrameBgActive, pressed},
      {ImGuiCol_Button, raised},
      {ImGuiCol_ButtonHovered, hovered},
      {ImGuiCol_ButtonActive, pressed},
      {ImGuiCol_Header, IM_COL32(0, 0, 0, 0)},
      {ImGuiCol_HeaderHovered, hovered},
      {ImGuiCol_HeaderActive, pressed},
      {ImGuiCol_SliderGrab, accent},
      {ImGuiCol_SliderGrabActive, accent},
      {ImGuiCol_CheckMark, accent},
      {ImGuiCol_TitleBg, raised},
      {ImGuiCol_TitleBgActive, raised},
      {ImGuiCol_TextSelectedBg, tinted},
      {ImGuiCol_ScrollbarBg, panel},
      {ImGuiCol_ScrollbarGrab, pressed},
      {ImGuiCol_ModalWindowDimBg, IM_COL32(0x0a, 0x0b, 0x0d, 150)},
  };
  for (const auto& [which, value] : rows) colors[which] = color(value);
}

}  // namespace

void load_theme(double scale, double density) {
  current_scale = scale;
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  io.Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  io.Fonts->FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
  current_fonts.body = load_font("DejaVuSans.ttf", 14.0 * scale, density);
  current_fonts.small = load_font("DejaVuSans.ttf", 12.0 * scale, density);
  current_fonts.strong = load_font("DejaVuSans-Bold.ttf", 14.0 * scale, density);
  io.Fonts->Build();
  io.FontGlobalScale = static_cast<float>(1.0 / density);

  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  set_colors(style.Colors);
  style.WindowPadding = {12, 10};
  style.FramePadding = {8, 3};
  style.ItemSpacing = {8, 5};
  style.ItemInnerSpacing = {6, 4};
  style.WindowBorderSize = 0;
  style.PopupBorderSize = 1;
  style.WindowRounding = 0;
  style.PopupRounding = 6;
  style.FrameRounding = 4;
  style.GrabRounding = 3;
  style.GrabMinSize = 8;
  style.ScrollbarSize = 10;
  style.WindowTitleAlign = {0.0f, 0.5f};
  style.ScaleAllSizes(static_cast<float>(scale));
  ImGui::GetStyle() = style;
}

const Fonts& fonts() { return current_fonts; }
float units(double length) { return static_cast<float>(length * current_scale); }

ImU32 to_imgui(Color color, int alpha) { return IM_COL32(color.red, color.green, color.blue, alpha); }

}  // namespace hooke
