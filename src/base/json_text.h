// Scans a JSON text once: checks that it is valid within our limits, and reports where its top-level members and the items
// of its lists are. Builds no values.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace hooke {

struct JsonVisitor {
  // Whether to report the items of the top-level list `key` one by one.
  std::function<bool(std::string_view key)> is_list;
  // Item `index` of such a list, as text.
  std::function<void(std::string_view key, std::size_t index, std::string_view text)> item;
  // A top-level member as a whole; a list is reported after its items.
  std::function<void(std::string_view key, std::string_view text)> member;
  // The text is a line of a file, which `name` identifies: messages give no line number.
  bool is_one_line = false;
};

// Throws InputError ("FILE: line N: ...") for text that is not a JSON object in UTF-8, and ("FILE: FIELD: ...") for duplicate keys, and for
// nesting, strings and items beyond file_limits.h. Not recursive. `name` is the file in messages.
void walk_json(const std::string& text, const std::string& name, const JsonVisitor& visitor);

}  // namespace hooke
