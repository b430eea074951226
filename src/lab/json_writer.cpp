#include "lab/json_writer.h"

#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <cassert>
#include <cmath>

#include "lab/bounds.h"
#include "lab/printable.h"

namespace hooke {

std::string to_json(const rapidjson::Value& value) {
  rapidjson::StringBuffer buffer;
  rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
  value.Accept(writer);
  return {buffer.GetString(), buffer.GetSize()};
}

std::string to_json(std::string_view text) {
  const std::string escaped = is_utf8(text) ? std::string(text) : printable(text);
  rapidjson::StringBuffer buffer;
  rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
  writer.String(escaped.data(), static_cast<rapidjson::SizeType>(escaped.size()));
  return {buffer.GetString(), buffer.GetSize()};
}

void JsonWriter::break_line() {
  written_ += '\n';
  written_.append(2 * levels_.size(), ' ');
}

// What stands before a value, or before a key.
void JsonWriter::separate() {
  if (std::exchange(after_key_, false) || levels_.empty()) return;
  Level& level = levels_.back();
  if (!level.is_empty) written_ += level.layout == Layout::Line ? ", " : ",";
  if (level.layout == Layout::Lines) break_line();
  level.is_empty = false;
}

void JsonWriter::begin(char open, char close, Layout layout) {
  separate();
  written_ += open;
  levels_.push_back({close, layout});
}

void JsonWriter::end() {
  const Level level = levels_.back();
  levels_.pop_back();
  if (level.layout == Layout::Lines && !level.is_empty) break_line();
  written_ += level.close;
  if (levels_.empty()) written_ += '\n';
}

void JsonWriter::key(std::string_view key) {
  separate();
  written_ += to_json(key) + ": ";
  after_key_ = true;
}

void JsonWriter::number(double value) {
  assert(std::isfinite(value));
  // many readers take "-0" for the whole number zero
  raw(value == 0.0 && std::signbit(value) ? "-0.0" : shortest(value));
}

void JsonWriter::vector(const Vec3& value) {
  begin_list(Layout::Line);
  for (int c = 0; c < 3; ++c) number(value[c]);
  end();
}

void JsonWriter::raw(std::string_view json) {
  separate();
  written_ += json;
}

}  // namespace hooke
