#include "lab/json_field.h"

#include <cassert>
#include <cmath>

#include "lab/json_writer.h"
#include "lab/printable.h"
#include "sim/errors.h"

namespace hooke {
namespace {

constexpr std::size_t most_shown = 60;  // bytes of a value in a message

std::string shown(const rapidjson::Value& value) {
  return value.IsNumber() ? shortest(value.GetDouble()) : printable(to_json(value), most_shown);
}

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

const rapidjson::Value& JsonParser::parse(std::string_view text) {
  document_.SetNull();
  pool_.Clear();
  document_.Parse<rapidjson::kParseFullPrecisionFlag | rapidjson::kParseIterativeFlag>(text.data(), text.size());
  assert(!document_.HasParseError());
  return document_;
}

}  // namespace hooke
