#include "ui/theme.h"

#include <imgui_freetype.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <utility>
#include <vector>

#include "draw/view.h"
#include "ui/font_files.h"

namespace hooke {
namespace {

// Part of the current context, like the global state of ImGui.
Fonts current_fonts;
double current_scale = 1.0;

// Latin, Greek and Cyrillic for names; punctuation, arrows and symbols for the panels.
constexpr ImWchar glyphs[] = {0x0020, 0x017f, 0x0370, 0x03ff, 0x0400, 0x04ff, 0x2010, 0x2027, 0x2070, 0x209f,
                              0x2190, 0x2193, 0x2200, 0x2265, 0x25a1, 0x25a1, 0x25cf, 0x25cf, 0};

constexpr ImWchar missing_glyph = 0x25a1;  // a box

// Chinese, Japanese and Korean characters of the texts so far: a font has too many to load all.
std::set<ImWchar> cjk_characters;
bool cjk_characters_are_new = false;
bool has_emoji = false;  // in the texts so far

// A line of that font is higher than one of the others, and its characters would be smaller.
void add_cjk_characters(float pixels) {
  constexpr float line_height = 1.2f;
  static std::vector<ImWchar> ranges;  // as long as the fonts
  ranges.clear();
  for (const ImWchar c : cjk_characters) ranges.insert(ranges.end(), {c, c});
  ranges.push_back(0);
  ImFontConfig config;
  config.MergeMode = true;
  if (const std::filesystem::path file = cjk_font_file(); !file.empty() && !cjk_characters.empty())
    ImGui::GetIO().Fonts->AddFontFromFileTTF(file.c_str(), std::round(line_height * pixels), &config, ranges.data());
}

// In whole pixels: the hinting of other sizes is blurred.
ImFont* load_font(const char* name, double size, double density) {
  const float pixels = static_cast<float>(std::round(size * density));
  ImGuiIO& io = ImGui::GetIO();
  if (const std::filesystem::path file = font_file(name); !file.empty())
    if (ImFont* font = io.Fonts->AddFontFromFileTTF(file.c_str(), pixels, nullptr, glyphs)) {
      font->FallbackChar = missing_glyph;
      add_cjk_characters(pixels);
      return font;
    }
  ImFontConfig config;
  config.SizePixels = pixels;
  return io.Fonts->AddFontDefault(&config);
}

// The colors of both themes by their use; text has the contrast of WCAG AA on the panel background.
struct ColorRow {
  ImU32& color;
  ImU32 dark, light;
};
const ColorRow color_rows[] = {
    {palette::panel, IM_COL32(0x1a, 0x1d, 0x22, 255), IM_COL32(0xf3, 0xf4, 0xf6, 255)},
    {palette::raised, IM_COL32(0x26, 0x2b, 0x32, 255), IM_COL32(0xe2, 0xe5, 0xe9, 255)},
    {palette::hovered, IM_COL32(0x31, 0x38, 0x41, 255), IM_COL32(0xd3, 0xd8, 0xde, 255)},
    {palette::pressed, IM_COL32(0x3b, 0x44, 0x4f, 255), IM_COL32(0xc3, 0xca, 0xd2, 255)},
    {palette::line, IM_COL32(0x2e, 0x34, 0x3c, 255), IM_COL32(0xd9, 0xdd, 0xe2, 255)},
    {palette::box, IM_COL32(0x20, 0x24, 0x2a, 255), IM_COL32(0xfc, 0xfc, 0xfd, 255)},
    {palette::text, IM_COL32(0xdc, 0xe1, 0xe7, 255), IM_COL32(0x1d, 0x23, 0x2a, 255)},
    {palette::dim, IM_COL32(0xa4, 0xae, 0xba, 255), IM_COL32(0x55, 0x5f, 0x6b, 255)},
    {palette::accent, IM_COL32(0x5b, 0xc0, 0xb0, 255), IM_COL32(0x0b, 0x75, 0x69, 255)},
    {palette::tinted, IM_COL32(0x24, 0x46, 0x44, 255), IM_COL32(0xbd, 0xe0, 0xdb, 255)},
    {palette::good, IM_COL32(0x74, 0xc2, 0x7a, 255), IM_COL32(0x23, 0x73, 0x2e, 255)},
    {palette::warning, IM_COL32(0xe6, 0xb4, 0x50, 255), IM_COL32(0x8a, 0x57, 0x00, 255)},
    {palette::bad, IM_COL32(0xf0, 0x6a, 0x5c, 255), IM_COL32(0xb3, 0x2a, 0x1e, 255)},
    {palette::edge, IM_COL32(0x42, 0x4b, 0x56, 255), IM_COL32(0xb4, 0xbc, 0xc6, 255)},
    {palette::shade, IM_COL32(0x12, 0x14, 0x18, 225), IM_COL32(0xff, 0xff, 0xff, 235)},
    {palette::alarm, IM_COL32(0x33, 0x22, 0x22, 245), IM_COL32(0xfb, 0xe6, 0xe3, 245)},
    {palette::axis_x, IM_COL32(0xe0, 0x74, 0x74, 255), IM_COL32(0xb4, 0x36, 0x36, 255)},
    {palette::axis_y, IM_COL32(0x8f, 0xc0, 0x72, 255), IM_COL32(0x3d, 0x73, 0x20, 255)},
    {palette::axis_z, IM_COL32(0x6c, 0xa6, 0xe8, 255), IM_COL32(0x2b, 0x62, 0xae, 255)},
    // of plots: after Okabe and Ito, distinguishable with every common color vision deficiency; blue, orange, green, mauve, vermilion, gray
    {palette::inks[0], IM_COL32(0x56, 0xb4, 0xe9, 255), IM_COL32(0x00, 0x72, 0xb2, 255)},
    {palette::inks[1], IM_COL32(0xe6, 0x9f, 0x00, 255), IM_COL32(0xb8, 0x74, 0x00, 255)},
    {palette::inks[2], IM_COL32(0x00, 0x9e, 0x73, 255), IM_COL32(0x00, 0x6a, 0x4d, 255)},
    {palette::inks[3], IM_COL32(0xcc, 0x79, 0xa7, 255), IM_COL32(0xb0, 0x4f, 0x8a, 255)},
    {palette::inks[4], IM_COL32(0xd5, 0x5e, 0x00, 255), IM_COL32(0xc2, 0x4a, 0x00, 255)},
    {palette::inks[5], IM_COL32(0x80, 0x80, 0x80, 255), IM_COL32(0x6b, 0x6b, 0x6b, 255)},
    {palette::notice, IM_COL32(0x30, 0x2b, 0x20, 245), IM_COL32(0xfa, 0xf0, 0xd8, 245)},
};

ImVec4 color(ImU32 packed) { return ImGui::ColorConvertU32ToFloat4(packed); }

void set_colors(ImVec4* colors) {
  using namespace palette;
  const std::pair<ImGuiCol, ImU32> parts[] = {
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
      {ImGuiCol_Tab, panel},
      {ImGuiCol_TabHovered, hovered},
      {ImGuiCol_TabActive, tinted},
      {ImGuiCol_TableHeaderBg, raised},
      {ImGuiCol_TableBorderLight, line},
      {ImGuiCol_TableRowBgAlt, panel},
      {ImGuiCol_NavHighlight, accent},
      {ImGuiCol_SeparatorHovered, accent},
      {ImGuiCol_SeparatorActive, accent},
      {ImGuiCol_ScrollbarBg, panel},
      {ImGuiCol_ScrollbarGrab, pressed},
      {ImGuiCol_ModalWindowDimBg, IM_COL32(0x0a, 0x0b, 0x0d, 150)},
  };
  for (const auto& [which, value] : parts) colors[which] = color(value);
}

}  // namespace

void use_look(Look look) {
  for (const ColorRow& row : color_rows) row.color = look == Look::Dark ? row.dark : row.light;
  set_colors(ImGui::GetStyle().Colors);
}

Color background_of(Look look) { return look == Look::Dark ? dark_background : light_background; }

void load_theme(double scale, double density) {
  if (palette::text == 0) use_look(Look::Dark);
  current_scale = scale;
  cjk_characters_are_new = false;
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
  style.WindowMinSize = {1, 1};
  ImGui::GetStyle() = style;
}

void follow_text(std::string_view text) {
  constexpr ImWchar first = 0x2e80, last = 0xffef;
  for (std::size_t i = 0; i + 2 < text.size(); ++i) {
    has_emoji = has_emoji || (text[i] & 0xf8) == 0xf0;
    if ((text[i] & 0xf0) != 0xe0) continue;
    const auto c = static_cast<ImWchar>((text[i] & 0x0f) << 12 | (text[i + 1] & 0x3f) << 6 | (text[i + 2] & 0x3f));
    if (c >= first && c <= last) cjk_characters_are_new = cjk_characters.insert(c).second || cjk_characters_are_new;
  }
}

bool needs_fonts() { return cjk_characters_are_new; }

std::string missing_font() {
  static bool cjk_is_reported = false, emoji_are_reported = false, font_is_checked = false;
  std::string text;
  if (!std::exchange(font_is_checked, true) && font_file("DejaVuSans.ttf").empty())
    text = "DejaVu Sans is missing: install the package fonts-dejavu-core";
  if (!cjk_characters.empty() && cjk_font_file().empty() && !std::exchange(cjk_is_reported, true))
    text = "Chinese, Japanese and Korean characters are shown as boxes until the package fonts-noto-cjk is installed";
  if (has_emoji && !std::exchange(emoji_are_reported, true))
    text += std::string(text.empty() ? "" : ". ") + "Emoji and other rare characters are shown as boxes";
  return text;
}

const Fonts& fonts() { return current_fonts; }
float units(double length) { return static_cast<float>(length * current_scale); }

Color to_color(ImU32 packed) {
  const auto channel = [&](int shift) { return static_cast<std::uint8_t>((packed >> shift) & 0xff); };
  return {channel(IM_COL32_R_SHIFT), channel(IM_COL32_G_SHIFT), channel(IM_COL32_B_SHIFT)};
}

ImU32 to_imgui(Color color, int alpha) { return IM_COL32(color.red, color.green, color.blue, alpha); }

}  // namespace hooke
