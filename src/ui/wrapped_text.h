// Text in lines, broken at spaces only and never between a number and its unit. ImGui itself also breaks after punctuation, as in "0." and
// "5 m".
#pragma once

#include <imgui.h>

#include <string>
#include <string_view>

#include "ui/theme.h"

namespace hooke {

// With line breaks, so that no line in the current font is wider than this [px], except that a longer word is broken anywhere.
std::string wrapped(std::string_view text, float width);
// The first lines of it; the last one ends with "..." where some are left out.
std::string wrapped(std::string_view text, float width, int max_lines);

// One line of at most this width; "..." replaces the rest.
std::string shortened(std::string text, float width);

// An item with the text in the width that is available.
void paragraph(std::string_view text, ImU32 color = palette::text);

}  // namespace hooke
