// Reads the text of a picture drawn by ImGui: every glyph is a rectangle of the font texture, which identifies it.
#pragma once

#include <imgui.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace hooke {

struct Glyph {
  ImWchar code;
  float u1, v1;
  float top, line;  // [px], below the top of its line, and the height of that
};
using Glyphs = std::map<std::pair<float, float>, Glyph>;

inline Glyphs glyphs_by_texture() {
  Glyphs glyphs;
  for (const ImFont* font : ImGui::GetIO().Fonts->Fonts)
    for (const ImFontGlyph& glyph : font->Glyphs)
      if (glyph.Visible)
        glyphs[{glyph.U0, glyph.V0}] = {static_cast<ImWchar>(glyph.Codepoint), glyph.U1, glyph.V1, glyph.Y0, font->FontSize};
  return glyphs;
}

inline void append_utf8(std::string& text, ImWchar code) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xc0 | (code >> 6));
    text += static_cast<char>(0x80 | (code & 0x3f));
  } else {
    text += static_cast<char>(0xe0 | (code >> 12));
    text += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
    text += static_cast<char>(0x80 | (code & 0x3f));
  }
}

// In drawing order; gaps become spaces, and new lines become line breaks.
inline std::string read_text(const ImDrawData& data) {
  const Glyphs glyphs = glyphs_by_texture();
  constexpr float gap = 2.6f;  // [px], less than a space in the smallest font
  std::string text;
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const auto& vertices = data.CmdLists[n]->VtxBuffer;
    ImVec2 end{-1e9f, -1e9f};
    for (int i = 0; i + 3 < vertices.Size; ++i) {
      const auto found = glyphs.find({vertices[i].uv.x, vertices[i].uv.y});
      if (found == glyphs.end() || vertices[i + 2].uv.x != found->second.u1 || vertices[i + 2].uv.y != found->second.v1) continue;
      // a letter may be higher or lower on its line, but by less than a line
      const bool same_line = std::abs(vertices[i + 2].pos.y - end.y) < 12.0f && vertices[i].pos.x > end.x - 4.0f;
      if (!same_line)
        text += '\n';
      else if (vertices[i].pos.x - end.x > gap)
        text += ' ';
      append_utf8(text, found->second.code);
      end = vertices[i + 2].pos;
      i += 3;
    }
  }
  return text;
}

}  // namespace hooke
