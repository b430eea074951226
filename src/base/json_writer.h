// Writes readable JSON: some objects and lists with one item per line, the others on a single line.
#pragma once

#include <rapidjson/document.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/types.h"

namespace hooke {

// A value, or a string in quotes, as JSON on one line. Bytes that are not valid UTF-8 are escaped.
std::string to_json(const rapidjson::Value& value);
std::string to_json(std::string_view text);

class JsonWriter {
 public:
  enum class Layout { Line, Lines };

  void begin_object(Layout layout) { begin('{', '}', layout); }
  void begin_list(Layout layout) { begin('[', ']', layout); }
  void end();
  void key(std::string_view key);

  // Every number, including -0.0, is read back bit for bit. It must be finite.
  void number(double value);
  // Null: it is not known, or not finite.
  void number(const std::optional<double>& value);
  void integer(std::int64_t value) { raw(std::to_string(value)); }
  void boolean(bool value) { raw(value ? "true" : "false"); }
  void null() { raw("null"); }
  void text(std::string_view value) { raw(to_json(value)); }
  void vector(const Vec3& value);

  // Existing JSON: a value, or members ("\"a\": 1, \"b\": 2").
  void raw(std::string_view json);
  void members(std::string_view json) {
    if (!json.empty()) raw(json);
  }

  // A list of what write(item) writes for each item.
  template <class Items, class Write>
  void list(Layout layout, const Items& items, const Write& write) {
    begin_list(layout);
    for (const auto& item : items) write(item);
    end();
  }

  // key and value at once
  void begin_object(std::string_view name, Layout layout) { key(name), begin_object(layout); }
  void begin_list(std::string_view name, Layout layout) { key(name), begin_list(layout); }
  template <class Items, class Write>
  void list(std::string_view name, Layout layout, const Items& items, const Write& write) {
    key(name), list(layout, items, write);
  }
  // A list of objects, one per line, whose members write(item) writes.
  template <class Items, class Write>
  void objects(std::string_view name, const Items& items, const Write& write) {
    list(name, Layout::Lines, items, [&](const auto& item) { begin_object(Layout::Line), write(item), end(); });
  }
  void raw(std::string_view name, std::string_view json) { key(name), raw(json); }
  void null(std::string_view name) { key(name), null(); }
  void number(std::string_view name, double value) { key(name), number(value); }
  void number(std::string_view name, const std::optional<double>& value) { key(name), number(value); }
  void integer(std::string_view name, std::int64_t value) { key(name), integer(value); }
  void boolean(std::string_view name, bool value) { key(name), boolean(value); }
  void text(std::string_view name, std::string_view value) { key(name), text(value); }
  void vector(std::string_view name, const Vec3& value) { key(name), vector(value); }

  const std::string& written() const { return written_; }
  // The text since the last call, for texts too long to keep in memory.
  std::string take() { return std::exchange(written_, {}); }

 private:
  struct Level {
    char close;
    Layout layout;
    bool is_empty = true;
  };
  void begin(char open, char close, Layout layout);
  void separate();
  void break_line();

  std::string written_;
  std::vector<Level> levels_;
  bool after_key_ = false;
};

}  // namespace hooke
