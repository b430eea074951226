#include "base/json_writer.h"

#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <cassert>
#include <cmath>

#include "base/bounds.h"
#include "base/printable.h"

namespace hooke {

namespace {

void write_value(JsonWriter& out, const rapidjson::Value& value) {
  using Layout = JsonWriter::Layout;
  switch (value.GetType()) {
    case rapidjson::kNullType:
      out.null();
      break;
    case rapidjson::kFalseType:
      out.boolean(false);
      break;
    case rapidjson::kTrueType:
      out.boolean(true);
      break;
    case rapidjson::kNumberType:
      out.number(value.GetDouble());
      break;
    case rapidjson::kStringType:
      out.text({value.GetString(), value.GetStringLength()});
      break;
    case rapidjson::kArrayType:
      out.list(Layout::Line, value.GetArray(), [&](const rapidjson::Value& item) { write_value(out, item); });
      break;
    case rapidjson::kObjectType:
      out.begin_object(Layout::Line);
      for (const auto& member : value.GetObject()) {
        out.key({member.name.GetString(), member.name.GetStringLength()});
        write_value(out, member.value);
      }
      out.end();
      break;
  }
}

}  // namespace

std::string to_json(const rapidjson::Value& value) {
  JsonWriter out;
  write_value(out, value);
  return out.take();
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

// The separator before a value or a key.
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
}

void JsonWriter::key(std::string_view key) {
  separate();
  written_ += to_json(key) + ": ";
  after_key_ = true;
}

void JsonWriter::number(double value) {
  assert(std::isfinite(value));
  // many readers read "-0" as the integer zero
  raw(value == 0.0 && std::signbit(value) ? "-0.0" : format_exact(value));
}

void JsonWriter::number(const std::optional<double>& value) { value&& std::isfinite(*value) ? number(*value) : null(); }

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
