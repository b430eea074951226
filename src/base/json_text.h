// A JSON text looked through once, from the outside: is it JSON within our limits, and where do its top-level members
// and the items of its lists stand? Nothing is built from it here.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace hooke {

struct JsonVisitor {
  // Whether the items of the top-level list `key` are wanted one by one.
  std::function<bool(std::string_view key)> is_list;
  // Item `index` of such a list, as it stands in the text.
  std::function<void(std::string_view key, std::size_t index, std::string_view text)> item;
  // A top-level member as a whole; such a list after its items.
  std::function<void(std::string_view key, std::string_view text)> member;
  // The text is a line of a file, and the name tells which: no line is told besides.
  bool is_one_line = false;
};

// Throws InputError ("FILE: line N: ...") for what is no JSON object in UTF-8, and ("FILE: FIELD: ...") for the same key
// twice, nesting, strings and items beyond file_limits.h. Uses no recursion. `name` stands for the file.
void walk_json(const std::string& text, const std::string& name, const JsonVisitor& visitor);

}  // namespace hooke
