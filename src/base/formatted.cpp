#include "base/formatted.h"

#include <cstdarg>
#include <cstdio>

namespace hooke {
namespace {

void append(std::string& text, const char* pattern, va_list arguments) {
  va_list again;
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, pattern, again);
  va_end(again);
  if (length < 0) return;
  const std::size_t start = text.size();
  text.resize(start + static_cast<std::size_t>(length) + 1);  // vsnprintf writes a final zero
  std::vsnprintf(text.data() + start, static_cast<std::size_t>(length) + 1, pattern, arguments);
  text.pop_back();
}

}  // namespace

std::string formatted(const char* pattern, ...) {
  std::string text;
  va_list arguments;
  va_start(arguments, pattern);
  append(text, pattern, arguments);
  va_end(arguments);
  return text;
}

void append_formatted(std::string& text, const char* pattern, ...) {
  va_list arguments;
  va_start(arguments, pattern);
  append(text, pattern, arguments);
  va_end(arguments);
}

}  // namespace hooke
