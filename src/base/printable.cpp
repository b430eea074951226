#include "base/printable.h"

#include <cstdint>

#include "base/formatted.h"

namespace hooke {
namespace {

// The code point that starts the text, and its length in bytes; length 0: not UTF-8.
struct CodePoint {
  std::uint32_t value = 0;
  std::size_t length = 0;
};

CodePoint first_code_point(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xc2 && lead < 0xe0 ? 2 : lead >= 0xe0 && lead < 0xf0 ? 3 : lead >= 0xf0 && lead < 0xf5 ? 4 : 0;
  if (length == 0 || text.size() < length) return {};

  std::uint32_t value = lead & (0xffu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    value = value << 6 | (byte(i) & 0x3f);
  }
  constexpr std::uint32_t min[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = value >= 0xd800 && value < 0xe000;
  return value < min[length] || value > 0x10ffff || surrogate ? CodePoint{} : CodePoint{value, length};
}

// Whether a byte of UTF-8 continues a character: text is not divided before it.
bool is_in_character(char byte) { return (static_cast<unsigned char>(byte) & 0xc0) == 0x80; }

// C0, DEL, C1, line separators, and marks that change the writing direction.
bool is_control(std::uint32_t c) {
  return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x2028 || c == 0x2029 || (c >= 0x202a && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const CodePoint c = first_code_point(text);
    const std::size_t length = c.length == 0 ? 1 : c.length;
    if (c.length == 0)
      shown += formatted("\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(text[0])));
    else if (c.value == '\n')
      shown += "\\n";
    else if (c.value == '\t')
      shown += "\\t";
    else if (is_control(c.value))
      shown += formatted("\\u%04x", static_cast<unsigned>(c.value));
    else
      shown += text.substr(0, length);
    text.remove_prefix(length);
  }
  return shown;
}

std::string printable(std::string_view text, std::size_t max) {
  if (text.size() <= max) return printable(text);
  while (max > 0 && is_in_character(text[max])) --max;
  return printable(text.substr(0, max)) + "...";
}

std::string without_middle(std::string_view text, std::size_t max) {
  if (text.size() <= max) return std::string(text);
  std::size_t begin = max / 2, end = text.size() - max / 2;
  while (begin > 0 && is_in_character(text[begin])) --begin;
  while (end < text.size() && is_in_character(text[end])) ++end;
  return std::string(text.substr(0, begin)) + "..." + std::string(text.substr(end));
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = first_code_point(text).length;
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace hooke
