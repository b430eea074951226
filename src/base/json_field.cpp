#include "base/json_field.h"

#include <rapidjson/memorystream.h>
#include <rapidjson/reader.h>

#include <cmath>

#include "base/errors.h"
#include "base/json_text.h"
#include "base/json_writer.h"
#include "base/option_error.h"
#include "base/printable.h"
#include "base/text_lines.h"

namespace hooke {
namespace {

constexpr std::size_t max_quoted_bytes = 60;  // bytes of a value in a message

std::string shown(const rapidjson::Value& value) { return printable(to_json(value), max_quoted_bytes); }

}  // namespace

double JsonField::number(const Bounds& bounds) const {
  if (!value_->IsNumber()) refuse("must be a number");
  const double value = value_->GetDouble();
  if (!std::isfinite(value)) refuse("must be a number below 1.8e308");
  if (const std::string reason = why_refused(value, bounds); !reason.empty()) refuse(reason);
  return value;
}

std::int64_t JsonField::integer(std::int64_t min, std::int64_t max) const {
  const Bounds bounds{.min = static_cast<double>(min), .max = static_cast<double>(max)};
  const double value = number();
  if (value != std::floor(value) || !bounds.contains(value))
    refuse("must be a whole number from " + std::to_string(min) + " to " + std::to_string(max));
  return static_cast<std::int64_t>(value);
}

bool JsonField::boolean() const {
  if (!value_->IsBool()) refuse("must be true or false");
  return value_->GetBool();
}

std::string_view JsonField::text() const {
  if (!value_->IsString()) refuse("must be a string \"...\"");
  return {value_->GetString(), value_->GetStringLength()};
}

JsonField::Parts<false> JsonField::items(std::size_t min, std::size_t max) const {
  if (!value_->IsArray()) refuse("must be a list [...]");
  if (value_->Size() < min || value_->Size() > max)
    refuse("must have " + (min == max ? std::to_string(min) : std::to_string(min) + " to " + std::to_string(max)) + " items");
  return Parts<false>(*this);
}

JsonField::Parts<true> JsonField::members() const {
  if (!value_->IsObject()) refuse("must be an object {...}");
  return Parts<true>(*this);
}

std::string JsonField::path() const {
  std::string path_text = parent_ == nullptr ? "" : parent_->path();
  if (!key_.empty() || index_ == not_an_item) path_text += (path_text.empty() ? "" : ".") + printable(key_, max_quoted_bytes);
  if (index_ != not_an_item) path_text += "[" + std::to_string(index_) + "]";
  return path_text;
}

std::string JsonField::error_text(std::string_view limit) const {
  return *file_ + ": " + path() + ": " + shown(*value_) + ": " + std::string(limit);
}

void JsonField::refuse(std::string_view limit) const { throw InputError(error_text(limit)); }

void JsonField::refuse_missing(std::string_view key, std::string_view limit) const {
  throw InputError(*file_ + ": " + path() + "." + std::string(key) + ": missing: " + std::string(limit));
}

namespace {

// Passes events on to a document. Numbers are passed as their digits and read by the C++ library: rapidjson reads 100e307, which is out of
// range, as -3.1e-308.
struct ExactNumbers {
  rapidjson::Document& document;
  bool Null() { return document.Null(); }
  bool Bool(bool value) { return document.Bool(value); }
  bool Int(int value) { return document.Int(value); }
  bool Uint(unsigned value) { return document.Uint(value); }
  bool Int64(std::int64_t value) { return document.Int64(value); }
  bool Uint64(std::uint64_t value) { return document.Uint64(value); }
  bool Double(double value) { return document.Double(value); }
  bool RawNumber(const char* digits, rapidjson::SizeType length, bool) { return document.Double(parse_number({digits, length}).value()); }
  bool String(const char* text, rapidjson::SizeType length, bool copy) { return document.String(text, length, copy); }
  bool Key(const char* text, rapidjson::SizeType length, bool copy) { return document.Key(text, length, copy); }
  bool StartObject() { return document.StartObject(); }
  bool EndObject(rapidjson::SizeType members) { return document.EndObject(members); }
  bool StartArray() { return document.StartArray(); }
  bool EndArray(rapidjson::SizeType items) { return document.EndArray(items); }
};

}  // namespace

const rapidjson::Value& JsonParser::parse(std::string_view text) {
  document_.SetNull();
  pool_.Clear();
  const auto events = [&](rapidjson::Document& document) {
    rapidjson::MemoryStream stream(text.data(), text.size());
    ExactNumbers handler{document};
    rapidjson::Reader reader;
    return !reader.Parse<rapidjson::kParseNumbersAsStringsFlag | rapidjson::kParseIterativeFlag>(stream, handler).IsError();
  };
  document_.Populate(events);
  return document_;
}

void read_members(const std::string& text, const std::string& name, const std::function<void(const JsonField& field)>& take,
                  bool is_one_line) {
  JsonParser parser;
  const auto take_member = [&](std::string_view key, std::string_view value) { take(JsonField(name, key, parser.parse(value))); };
  walk_json(text, name, {.is_list = [](std::string_view) { return false; }, .item = {}, .member = take_member, .is_one_line = is_one_line});
}

}  // namespace hooke
