// A value of a JSON file and its path. Reading it checks type and limits; an error is one line that names the file, the
// field, the value and the limit.
#pragma once

#include <rapidjson/document.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

#include "base/bounds.h"

namespace hooke {

class JsonField {
 public:
  using Value = rapidjson::Value;
  static constexpr std::size_t not_an_item = std::numeric_limits<std::size_t>::max();

  // At the top of the file `file`: "gravity", or item `index` of a list: "points[3]".
  JsonField(const std::string& file, std::string_view key, const Value& value, std::size_t index = not_an_item)
      : file_(&file), key_(key), value_(&value), index_(index) {}

  bool is_null() const { return value_->IsNull(); }
  bool is_object() const { return value_->IsObject(); }
  bool is_number() const { return value_->IsNumber(); }
  bool is_array() const { return value_->IsArray(); }
  bool is(std::string_view key) const { return key_ == key && index_ == not_an_item; }
  std::string_view key() const { return key_; }
  const Value& value() const { return *value_; }

  double number(const Bounds& bounds = any_number) const;
  std::int64_t integer(std::int64_t min, std::int64_t max) const;
  bool boolean() const;
  std::string_view text() const;

  // Items of an array of `min` to `max` items, members of an object. Parents must outlive their parts.
  template <bool of_object>
  class Parts;
  Parts<false> items(std::size_t min, std::size_t max) const;
  Parts<true> members() const;

  std::string path() const;
  // "FILE: FIELD: VALUE: LIMIT", and the same thrown as InputError.
  std::string error_text(std::string_view limit) const;
  [[noreturn]] void refuse(std::string_view limit) const;
  // The same for a missing member.
  [[noreturn]] void refuse_missing(std::string_view key, std::string_view limit) const;

 private:
  JsonField(const JsonField& parent, std::string_view key, const Value& value, std::size_t index)
      : file_(parent.file_), parent_(&parent), key_(key), value_(&value), index_(index) {}

  const std::string* file_;
  const JsonField* parent_ = nullptr;
  std::string_view key_;
  const Value* value_;
  std::size_t index_;
};

template <bool of_object>
class JsonField::Parts {
 public:
  explicit Parts(const JsonField& container) : container_(&container) {}
  std::size_t size() const {
    if constexpr (of_object)
      return container_->value_->MemberCount();
    else
      return container_->value_->Size();
  }
  JsonField operator[](std::size_t i) const {
    if constexpr (of_object) {
      const auto& member = container_->value_->MemberBegin()[static_cast<std::ptrdiff_t>(i)];
      return {*container_, {member.name.GetString(), member.name.GetStringLength()}, member.value, not_an_item};
    } else {
      return {*container_, {}, (*container_->value_)[static_cast<rapidjson::SizeType>(i)], i};
    }
  }

  struct Iterator {
    const Parts* parts;
    std::size_t i;
    JsonField operator*() const { return (*parts)[i]; }
    Iterator& operator++() {
      ++i;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return i != other.i; }
  };
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, size()}; }

 private:
  const JsonField* container_;
};

// Parses a text that walk_json has accepted; the value is valid until the next parse.
class JsonParser {
 public:
  const rapidjson::Value& parse(std::string_view text);

 private:
  char buffer_[1 << 14];
  rapidjson::MemoryPoolAllocator<> pool_{buffer_, sizeof buffer_};
  rapidjson::Document document_{&pool_};
};

// Calls `take` with every top-level member of a text. Throws what walk_json does; `is_one_line`: as JsonVisitor.
void read_members(const std::string& text, const std::string& name, const std::function<void(const JsonField& field)>& take,
                  bool is_one_line = false);

}  // namespace hooke
