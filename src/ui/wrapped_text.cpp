#include "ui/wrapped_text.h"

#include <algorithm>

#include "ui/widgets.h"

namespace hooke {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

float width_of(std::string_view text) { return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x; }

std::size_t length_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

// "0.5", "-12", "(3", "~2e-3"
bool is_number(std::string_view word) {
  const auto first = word.find_first_not_of("(+-~\"");
  return first != word.npos && is_digit(word[first]) && is_digit(word.back());
}

// "m", "kg,", "N/m", "%": one or two letters, or a quotient; and "substeps", "degrees".
bool is_unit(std::string_view word) {
  const auto last = word.find_last_not_of(".,;:)\"");
  if (last == word.npos) return false;
  word = word.substr(0, last + 1);
  if (word == "substep" || word == "substeps" || word == "degrees") return true;
  return length_of(word) <= 2 || (word.find('/') != word.npos && length_of(word) <= 6);
}

// Spaces and the word after them. `sticks`: to the word before.
struct Word {
  std::string_view spaces, letters;
  bool sticks = false;
};

std::vector<Word> words_of(std::string_view line) {
  std::vector<Word> words;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t begin = std::min(line.find_first_not_of(' ', at), line.size());
    const std::size_t end = std::min(line.find(' ', begin), line.size());
    Word word{line.substr(at, begin - at), line.substr(begin, end - begin)};
    if (!words.empty()) {
      const Word& before = words.back();
      // the second part of "N s/m" too
      word.sticks = is_unit(word.letters) && (is_number(before.letters) || (before.sticks && word.letters.find('/') != line.npos));
    }
    words.push_back(word);
    at = end;
  }
  return words;
}

// The longest start of a word that fits, at least one letter.
std::size_t fitting(std::string_view word, float width) {
  std::size_t end = 0;
  for (std::size_t next = 1; next <= word.size(); ++next) {
    if (next < word.size() && (word[next] & 0xc0) == 0x80) continue;
    if (end > 0 && width_of(word.substr(0, next)) > width) break;
    end = next;
  }
  return end;
}

void wrap_line(std::string_view line, float width, std::string& text) {
  const std::vector<Word> words = words_of(line);
  std::string now;
  for (std::size_t i = 0; i < words.size();) {
    // what stays together
    std::size_t end = i + 1;
    std::string part(words[i].letters);
    for (; end < words.size() && words[end].sticks; ++end) part.append(words[end].spaces).append(words[end].letters);

    std::string longer = now;
    longer.append(words[i].spaces).append(part);
    if (width_of(longer) <= width) {
      now = std::move(longer);
    } else {
      if (!now.empty()) text.append(now) += '\n';
      for (; width_of(part) > width && length_of(part) > 1; part.erase(0, fitting(part, width)))
        text.append(part, 0, fitting(part, width)) += '\n';
      now = std::move(part);
    }
    i = end;
  }
  text.append(now);
}

}  // namespace

std::string wrapped(std::string_view text, float width) {
  std::string result;
  for (std::size_t at = 0;;) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    wrap_line(text.substr(at, end - at), width, result);
    if (end == text.size()) return result;
    result += '\n';
    at = end + 1;
  }
}

std::string wrapped(std::string_view text, float width, int max_lines) {
  std::string lines = wrapped(text, width);
  std::size_t end = 0;
  for (int line = 0; line < max_lines && end != lines.npos; ++line) end = lines.find('\n', end + (line > 0 ? 1 : 0));
  if (end == lines.npos) return lines;
  lines.resize(end);
  const std::size_t begin = lines.find_last_of('\n') + 1;
  constexpr std::string_view rest = " ...";
  while (lines.size() > begin && width_of(lines.substr(begin)) + width_of(rest) > width) {
    const std::size_t space = lines.find_last_of(' ');
    lines.resize(space == lines.npos || space < begin ? begin : space);
  }
  return lines.append(rest);
}

std::string shortened(std::string text, float width) {
  constexpr std::string_view rest = "...";
  if (width_of(text) <= width) return text;
  text.resize(width > width_of(rest) ? fitting(text, width - width_of(rest)) : 0);
  return text.append(rest);
}

void paragraph(std::string_view text, ImU32 color) { text_in(color, wrapped(text, ImGui::GetContentRegionAvail().x)); }

}  // namespace hooke
