#include "lab/json_field.h"

#include <rapidjson/memorystream.h>
#include <rapidjson/reader.h>

#include <cmath>

#include "lab/json_writer.h"
#include "lab/printable.h"
#include "lab/text_lines.h"
#include "sim/errors.h"

namespace hooke {
namespace {

constexpr std::size_t most_shown = 60;  // bytes of a value in a message

std::string shown(const rapidjson::Value& value) { return printable(to_json(value), most_shown); }

}  // namespace

double JsonField::number(const Bounds& bounds) const {
  if (!value_->IsNumber()) refuse("must be a number");
  const double value = value_->GetDouble();
  if (!std::isfinite(value)) refuse("must be a number below 1.8e308");
  if (!bounds.hold(value)) refuse(bounds.text());
  return value;
}

std::int64_t JsonField::whole(std::int64_t least, std::int64_t most) const {
  const Bounds bounds{.least = static_cast<double>(least), .most = static_cast<double>(most)};
  const double value = number();
  if (value != std::floor(value) || !bounds.hold(value))
    refuse("must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<std::int64_t>(value);
}

bool JsonField::boolean() const {
  if (!value_->IsBool()) refuse("must be true or false");
  return value_->GetBool();
}

std::string_view JsonField::text() const {
  if (!value_->IsString()) refuse("must be a text \"...\"");
  return {value_->GetString(), value_->GetStringLength()};
}

JsonField::Parts<false> JsonField::items(std::size_t least, std::size_t most) const {
  if (!value_->IsArray()) refuse("must be a list [...]");
  if (value_->Size() < least || value_->Size() > most)
    refuse("must have " + (least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most)) + " items");
  return Parts<false>(*this);
}

JsonField::Parts<true> JsonField::members() const {
  if (!value_->IsObject()) refuse("must be an object {...}");
  return Parts<true>(*this);
}

std::string JsonField::path() const {
  std::string way = parent_ == nullptr ? "" : parent_->path();
  if (!key_.empty() || index_ == not_an_item) way += (way.empty() ? "" : ".") + printable(key_, most_shown);
  if (index_ != not_an_item) way += "[" + std::to_string(index_) + "]";
  return way;
}

std::string JsonField::complaint(std::string_view limit) const {
  return *file_ + ": " + path() + ": " + shown(*value_) + ": " + std::string(limit);
}

void JsonField::refuse(std::string_view limit) const { throw Refused(complaint(limit)); }

void JsonField::refuse_missing(std::string_view key, std::string_view limit) const {
  throw Refused(*file_ + ": " + path() + "." + std::string(key) + ": missing: " + std::string(limit));
}

namespace {

// Passes events on to a document. Numbers come as their digits and are read by the C++ library: rapidjson takes 100e307,
// which is beyond all numbers, for -3.1e-308.
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

}  // namespace hooke
