// The text of a frame of the panels as it is drawn, glyph by glyph: what clips it, what it overlaps, and its contrast.
#pragma once

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/gui_text.h"

namespace hooke {

struct Letter {
  ImVec4 box;   // minimum x, y, maximum x, y
  ImVec4 clip;  // likewise, the clip rectangle
  ImWchar code;
  int run;  // glyphs of one piece of text
  ImU32 color;
  int vertex;  // its first in the list, which is in the order of drawing
  float line_top, line_height;
  bool is_seen() const { return box.x < clip.z && box.z > clip.x && box.y < clip.w && box.w > clip.y; }
};

struct Sheet {
  std::string window;
  bool scrolls = false;       // vertically, so that clipped text can be scrolled into view
  std::set<std::string> cut;  // text that ends within a letter at the edge of an item
  std::vector<Letter> letters;
  const ImDrawList* list = nullptr;
};

inline std::string words_of(const Sheet& sheet, int run) {
  std::string words;
  for (const Letter& letter : sheet.letters)
    if (letter.run == run) append_utf8(words, letter.code);
  return words;
}

inline std::vector<Sheet> read_sheets(const ImDrawData& data) {
  const Glyphs glyphs = glyphs_by_texture();
  std::vector<Sheet> sheets;
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const ImDrawList& list = *data.CmdLists[n];
    std::vector<ImVec4> clips(static_cast<std::size_t>(list.VtxBuffer.Size));
    for (const ImDrawCmd& command : list.CmdBuffer)
      for (unsigned i = 0; i < command.ElemCount; ++i)
        clips[command.VtxOffset + list.IdxBuffer[static_cast<int>(command.IdxOffset + i)]] = command.ClipRect;

    Sheet sheet{.window = list._OwnerName, .list = &list};
    if (const ImGuiWindow* window = ImGui::FindWindowByName(list._OwnerName)) sheet.scrolls = window->ScrollMax.y > 0.0f;
    int run = 0;
    for (int i = 0; i + 3 < list.VtxBuffer.Size; ++i) {
      const ImDrawVert &min = list.VtxBuffer[i], &max = list.VtxBuffer[i + 2];
      const auto found = glyphs.find({min.uv.x, min.uv.y});
      if (found == glyphs.end()) continue;
      if (max.uv.x < found->second.u1 && max.uv.y == found->second.v1 && max.pos.x > min.pos.x && !sheet.letters.empty())
        sheet.cut.insert(words_of(sheet, run));
      if (max.uv.x != found->second.u1 || max.uv.y != found->second.v1) continue;
      const bool progress = !sheet.letters.empty() && std::abs(max.pos.y - sheet.letters.back().box.w) < 12.0f &&
                            std::abs(min.pos.x - sheet.letters.back().box.z) < 14.0f;
      if (!progress) ++run;
      sheet.letters.push_back({{min.pos.x, min.pos.y, max.pos.x, max.pos.y},
                               clips[static_cast<std::size_t>(i)],
                               found->second.code,
                               run,
                               min.col,
                               i,
                               min.pos.y - found->second.top,
                               found->second.line});
      i += 3;
    }
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

inline std::string all_letters(const ImDrawData& data) {
  std::string letters;
  for (const Sheet& sheet : read_sheets(data))
    for (const Letter& letter : sheet.letters) append_utf8(letters, letter.code);
  return letters;
}
inline std::string without_spaces(std::string text) {
  std::erase(text, ' ');
  return text;
}

// Text clipped horizontally, or vertically where nothing scrolls, and overlapping text. Each reported once.
inline std::set<std::string> faults(const ImDrawData& data) {
  constexpr float slack = 1.5f;
  std::set<std::string> found;
  for (const Sheet& sheet : read_sheets(data)) {
    for (const std::string& words : sheet.cut) found.insert(sheet.window + ": cut: " + words);
    for (const Letter& letter : sheet.letters) {
      if (!letter.is_seen()) continue;
      const bool is_cut = letter.box.x < letter.clip.x - slack || letter.box.z > letter.clip.z + slack ||
                          (!sheet.scrolls && (letter.box.y < letter.clip.y - slack || letter.box.w > letter.clip.w + slack));
      if (is_cut) found.insert(sheet.window + ": cut: " + words_of(sheet, letter.run));
    }
    for (std::size_t a = 0; a < sheet.letters.size(); ++a)
      for (std::size_t b = a + 1; b < sheet.letters.size(); ++b) {
        const Letter &first = sheet.letters[a], &second = sheet.letters[b];
        if (first.run == second.run || !first.is_seen() || !second.is_seen()) continue;
        const float wide = std::min(first.box.z, second.box.z) - std::max(first.box.x, second.box.x);
        const float high = std::min(first.box.w, second.box.w) - std::max(first.box.y, second.box.y);
        if (wide > slack && high > slack)
          found.insert(sheet.window + ": on each other: " + words_of(sheet, first.run) + " | " + words_of(sheet, second.run));
      }
  }
  return found;
}

// Lines of one text that separate a number from its unit, or its digits: "0." and "5 m", "5" and "m".
inline std::set<std::string> split_quantities(const ImDrawData& data) {
  static const std::set<std::string> units{"m", "mm", "\u03bcm", "s", "ms",    "kg",  "N",       "N/m",
                                           "J", "kJ", "W",       "%", "N s/m", "m/s", "degrees", "substeps"};
  std::set<std::string> found;
  for (const Sheet& sheet : read_sheets(data)) {
    std::size_t begin = 0;  // of the line
    for (std::size_t i = 1; i < sheet.letters.size(); ++i) {
      const Letter &last = sheet.letters[i - 1], &first = sheet.letters[i];
      if (std::abs(first.line_top - last.line_top) < 1.0f && first.box.x > last.box.x) continue;
      const Letter& start = sheet.letters[begin];
      const std::size_t line_begin = std::exchange(begin, i);
      // items have a gap between them, the lines of one text have none
      const bool is_continued =
          std::abs(first.line_top - last.line_top - last.line_height) < 0.6f && std::abs(first.box.x - start.box.x) < 3.0f;
      if (!is_continued) continue;
      std::string word;
      for (std::size_t k = i;
           k < sheet.letters.size() && (k == i || sheet.letters[k].box.x - sheet.letters[k - 1].box.z < 0.2f * first.line_height); ++k)
        append_utf8(word, sheet.letters[k].code);
      while (!word.empty() && std::string_view(".,;:)").find(word.back()) != std::string_view::npos) word.pop_back();
      const auto is_digit = [](ImWchar code) { return code >= '0' && code <= '9'; };
      const bool ends_in_point = last.code == '.' && i - line_begin > 1 && is_digit(sheet.letters[i - 2].code);
      if ((ends_in_point && is_digit(first.code)) || (is_digit(last.code) && units.contains(word)))
        found.insert(sheet.window + ": " + words_of(sheet, last.run) + " | " + words_of(sheet, first.run));
    }
  }
  return found;
}

// Of a color without alpha (WCAG 2.1).
inline double luminance(ImU32 color) {
  const auto linear = [](ImU32 byte) {
    const double c = static_cast<double>(byte & 0xff) / 255.0;
    return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color >> IM_COL32_R_SHIFT) + 0.7152 * linear(color >> IM_COL32_G_SHIFT) +
         0.0722 * linear(color >> IM_COL32_B_SHIFT);
}
inline double contrast(ImU32 a, ImU32 b) {
  const double bright = std::max(luminance(a), luminance(b)), dark = std::min(luminance(a), luminance(b));
  return (bright + 0.05) / (dark + 0.05);
}

// The color with its alpha over an opaque one.
inline ImU32 over(ImU32 ground, ImVec4 color) {
  const ImVec4 below = ImGui::ColorConvertU32ToFloat4(ground);
  const auto mix = [&](float from, float to) { return from + color.w * (to - from); };
  return ImGui::ColorConvertFloat4ToU32({mix(below.x, color.x), mix(below.y, color.y), mix(below.z, color.z), 1.0f});
}

// A triangle that is filled without a texture.
struct Fill {
  ImVec2 corners[3];
  ImU32 colors[3];
  ImVec4 clip;
  int vertex;  // the last one

  // Adds its color at a position to the ground.
  void paint(ImVec2 at, ImU32& ground) const {
    if (at.x < clip.x || at.x >= clip.z || at.y < clip.y || at.y >= clip.w) return;
    const auto [x0, x1] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    if (at.x < x0 || at.x > x1 || !ImTriangleContainsPoint(corners[0], corners[1], corners[2], at)) return;
    float u = 0.0f, v = 0.0f, w = 0.0f;
    ImTriangleBarycentricCoords(corners[0], corners[1], corners[2], at, u, v, w);
    ImVec4 color{};
    const float weights[] = {u, v, w};
    for (int i = 0; i < 3; ++i) {
      const ImVec4 part = ImGui::ColorConvertU32ToFloat4(colors[i]);
      color = {color.x + weights[i] * part.x, color.y + weights[i] * part.y, color.z + weights[i] * part.z, color.w + weights[i] * part.w};
    }
    ground = over(ground, color);
  }
};

inline std::vector<Fill> fills_of(const ImDrawList& list) {
  const ImVec2 white = ImGui::GetIO().Fonts->TexUvWhitePixel;
  std::vector<Fill> fills;
  for (const ImDrawCmd& command : list.CmdBuffer)
    for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
      Fill fill{.clip = command.ClipRect, .vertex = 0};
      bool is_plain = true;
      for (unsigned c = 0; c < 3; ++c) {
        const auto at = static_cast<int>(command.VtxOffset + list.IdxBuffer[static_cast<int>(command.IdxOffset + i + c)]);
        const ImDrawVert& vertex = list.VtxBuffer[at];
        is_plain = is_plain && vertex.uv.x == white.x && vertex.uv.y == white.y;
        fill.corners[c] = vertex.pos;
        fill.colors[c] = vertex.col;
        fill.vertex = std::max(fill.vertex, at);
      }
      if (is_plain) fills.push_back(fill);
    }
  return fills;
}

// Text with less contrast than WCAG AA demands (4.5), from its color and what is drawn below the middle of its first letter; 2.5 if it is
// disabled, and transparent for that reason. `scene`: the color behind the panels. Each reported once.
inline std::set<std::string> faint_text(const ImDrawData& data, ImU32 scene) {
  std::set<std::string> found;
  for (const Sheet& sheet : read_sheets(data)) {
    const std::vector<Fill> fills = fills_of(*sheet.list);
    int run = 0;
    for (const Letter& letter : sheet.letters) {
      if (letter.run == run || !letter.is_seen()) continue;
      run = letter.run;
      const ImVec2 middle{0.5f * (letter.box.x + letter.box.z), 0.5f * (letter.box.y + letter.box.w)};
      ImU32 ground = scene;
      for (const Fill& fill : fills)
        if (fill.vertex < letter.vertex) fill.paint(middle, ground);
      const ImVec4 color = ImGui::ColorConvertU32ToFloat4(letter.color);
      if (color.w == 0.0f) continue;
      if (contrast(over(ground, color), ground) < (color.w < 0.95f ? 2.5 : 4.5))
        found.insert(sheet.window + ": " + std::to_string(contrast(over(ground, color), ground)) + ": " + words_of(sheet, letter.run));
    }
  }
  return found;
}

// Digits below which the handle of a slider is drawn.
inline std::set<std::string> crossed_text(const ImDrawData& data, ImU32 ink) {
  std::set<std::string> found;
  for (const Sheet& sheet : read_sheets(data)) {
    const std::vector<Fill> fills = fills_of(*sheet.list);
    for (const Letter& letter : sheet.letters)
      for (const float fraction : {0.1f, 0.5f, 0.9f}) {
        const ImVec2 at{letter.box.x + fraction * (letter.box.z - letter.box.x), 0.5f * (letter.box.y + letter.box.w)};
        for (const Fill& fill : fills) {
          ImU32 ground = 0;
          if (fill.colors[0] == ink && fill.vertex < letter.vertex) fill.paint(at, ground);
          if (ground != 0) found.insert(sheet.window + ": " + words_of(sheet, letter.run));
        }
      }
  }
  return found;
}

}  // namespace hooke
