#include "base/json_text.h"

#include <rapidjson/error/en.h>
#include <rapidjson/reader.h>

#include <algorithm>
#include <vector>

#include "base/errors.h"
#include "base/file_limits.h"
#include "base/printable.h"
#include "base/text_lines.h"

namespace hooke {
namespace {

// A stream over a zero-terminated text. RapidJSON's own stream is copied while a token is read, so that a handler could not determine where
// the token ends.
struct TextStream {
  using Ch = char;
  const char* begin;
  const char* end;  // of the zero
  const char* at = begin;
  Ch Peek() const { return *at; }
  // RapidJSON takes all bytes that the first byte of a character announces, also where the text ends before them.
  Ch Take() { return at == end ? '\0' : *at++; }
  std::size_t Tell() const { return static_cast<std::size_t>(at - begin); }
  Ch* PutBegin() { return nullptr; }
  void Put(Ch) {}
  void Flush() {}
  std::size_t PutEnd(Ch*) { return 0; }
};

class Walker {
 public:
  Walker(const std::string& text, const std::string& name, const JsonVisitor& visitor) : text_(text), name_(name), visitor_(visitor) {}

  void walk() {
    const std::size_t zero = text_.find('\0');
    if (zero != std::string::npos) refuse(line(zero), "a zero byte: must be JSON text");

    rapidjson::Reader reader;
    const rapidjson::ParseResult result =
        reader.Parse<rapidjson::kParseIterativeFlag | rapidjson::kParseValidateEncodingFlag | rapidjson::kParseNumbersAsStringsFlag>(
            stream_, *this);
    if (result.IsError()) refuse_syntax(result);
  }

  // rapidjson's handler
  bool Null() { return scalar(); }
  bool Bool(bool) { return scalar(); }
  bool RawNumber(const char* digits, rapidjson::SizeType length, bool) {
    check_number({digits, length});
    return scalar();
  }
  // numbers come as their digits
  bool Int(int) { return false; }
  bool Uint(unsigned) { return false; }
  bool Int64(std::int64_t) { return false; }
  bool Uint64(std::uint64_t) { return false; }
  bool Double(double) { return false; }
  bool String(const char* string, rapidjson::SizeType length, bool) {
    check_string({string, length}, 1);
    return scalar();
  }

  bool Key(const char* string, rapidjson::SizeType length, bool) {
    levels_[depth_ - 1].keys.emplace_back(string, length);
    check_string({string, length}, 0);
    if (depth_ == 1) {
      member_begin_ = stream_.Tell();
      values_ = 0;
    }
    return true;
  }

  bool StartObject() { return start(false); }
  bool StartArray() { return start(true); }

  bool EndObject(rapidjson::SizeType) {
    // sorting, not searching: an object may have a million keys
    std::vector<std::string>& keys = levels_[depth_ - 1].keys;
    std::sort(keys.begin(), keys.end());
    const auto duplicate = std::adjacent_find(keys.begin(), keys.end());
    if (duplicate != keys.end()) {
      const std::string key = *duplicate;
      keys.clear();
      const std::string path_text = depth_ == 1 ? "" : path(depth_) + ".";
      refuse(path_text + printable(key, 60), "given twice: each key must be unique in its object");
    }
    return end();
  }

  bool EndArray(rapidjson::SizeType) { return end(); }

 private:
  struct Level {
    bool is_array = false;
    std::size_t items = 0;          // of an array, so far
    std::vector<std::string> keys;  // of an object, so far
  };

  bool scalar() {
    if (depth_ == 0) refuse(line(stream_.Tell()), "not an object: must be {...}");
    count_value();
    finish_value(stream_.Tell());
    return true;
  }

  bool start(bool is_array) {
    if (depth_ == 0 && is_array) refuse(line(stream_.Tell()), "not an object: must be {...}");
    if (depth_ > 0) count_value();
    if (depth_ == max_nesting)
      refuse(line(stream_.Tell()), "nesting: " + std::to_string(depth_ + 1) + ": must be at most " + std::to_string(max_nesting));
    Level& level = levels_[depth_++];
    level.is_array = is_array;
    level.items = 0;
    level.keys.clear();
    if (depth_ == 2 && is_array && visitor_.is_list(levels_[0].keys.back())) {
      in_visited_list_ = true;
      item_begin_ = stream_.Tell() + 1;
      values_ = 0;
    }
    return true;
  }

  bool end() {
    --depth_;
    if (depth_ == 1) in_visited_list_ = false;
    finish_value(stream_.Tell() + 1);
    return true;
  }

  // Counts a value, which may just begin, in its array and in its item.
  void count_value() {
    Level& level = levels_[depth_ - 1];
    if (level.is_array) ++level.items;
    if (++values_ > max_values_per_item)
      refuse(path(in_visited_list_ ? 2 : 1), std::to_string(values_) + " values: must be at most " + std::to_string(max_values_per_item));
  }

  // A value that ends here is reported if it is an item or a member.
  void finish_value(std::size_t end) {
    const auto value_from = [&](std::size_t begin) {
      std::string_view value(text_.data() + begin, end - begin);
      value.remove_prefix(std::min(value.find_first_not_of(" \t\r\n:,"), value.size()));
      return value;
    };
    if (in_visited_list_ && depth_ == 2) {
      visitor_.item(levels_[0].keys.back(), levels_[1].items - 1, value_from(item_begin_));
      item_begin_ = end;
      values_ = 0;
    } else if (depth_ == 1)
      visitor_.member(levels_[0].keys.back(), value_from(member_begin_));
  }

  void check_string(std::string_view string, std::size_t next) const {
    if (string.size() > max_string_bytes)
      refuse(path(depth_, next), "\"" + printable(string, 40) + "\": " + std::to_string(string.size()) + " bytes: must be at most " +
                                     std::to_string(max_string_bytes));
    // RapidJSON accepts a lone "\udc00", which would give invalid UTF-8
    if (!is_utf8(string)) refuse(line(stream_.Tell()), "a lone surrogate: must be UTF-8");
  }

  void check_number(std::string_view digits) const {
    if (!parse_number(digits)) refuse(path(depth_, 1), printable(digits, 40) + ": must be a number below 1.8e308");
  }

  // "points[3].mass": the path of the last value or, with next = 1, of the next one.
  std::string path(std::size_t levels, std::size_t next = 0) const {
    std::string path_text;
    for (std::size_t i = 0; i < levels; ++i) {
      const Level& level = levels_[i];
      if (level.is_array)
        path_text += "[" + std::to_string(level.items - 1 + (i + 1 == levels ? next : 0)) + "]";
      else if (!level.keys.empty())
        path_text += (path_text.empty() ? "" : ".") + printable(level.keys.back(), 60);
    }
    return path_text.empty() ? (visitor_.is_one_line ? "value" : "scene") : path_text;
  }

  std::string line(std::size_t offset) const {
    if (visitor_.is_one_line) return {};
    return "line " +
           std::to_string(1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text_.size())), '\n'));
  }

  [[noreturn]] void refuse(const std::string& where, const std::string& what) const {
    throw InputError(name_ + ": " + where + (where.empty() ? "" : ": ") + what);
  }

  [[noreturn]] void refuse_syntax(const rapidjson::ParseResult& result) const {
    const std::size_t offset = std::min(result.Offset(), text_.size());
    if (text_.find_first_not_of(" \t\r\n") == std::string::npos) refuse("line 1", "empty: must be a JSON object {...}");

    std::string where = line(offset), what = rapidjson::GetParseError_En(result.Code());
    if (result.Code() == rapidjson::kParseErrorNumberTooBig) {
      const std::size_t end = text_.find_first_not_of("+-.0123456789eE", offset);
      check_number(std::string_view(text_).substr(offset, end - offset));
    }
    if (result.Code() == rapidjson::kParseErrorStringInvalidEncoding) what = "invalid UTF-8 in a string";
    if (offset == text_.size()) what = "unexpected end of the file";
    while (!what.empty() && what.back() == '.') what.pop_back();
    if (text_.starts_with("\xef\xbb\xbf")) refuse(where, "a byte order mark: must begin with {");
    if (result.Code() == rapidjson::kParseErrorValueInvalid && offset < text_.size()) {
      // from the start of the word in which reading failed
      const std::size_t before = text_.find_last_of(" \t\r\n,:[{", offset == 0 ? 0 : offset - 1);
      const std::size_t begin = before == std::string::npos ? 0 : before + 1, end = text_.find_first_of(" \t\r\n,:]}", offset);
      where += (where.empty() ? "" : ": ") + path(depth_, 1);
      what = printable(text_.substr(begin, std::min(end, text_.size()) - begin), 40) + ": must be a JSON value (numbers are finite)";
    }
    refuse(where, what);
  }

  const std::string& text_;
  const std::string& name_;
  const JsonVisitor& visitor_;
  TextStream stream_{text_.c_str(), text_.c_str() + text_.size()};
  std::vector<Level> levels_{max_nesting};  // kept for reuse, `depth_` of them are open
  std::size_t depth_ = 0;
  bool in_visited_list_ = false;  // inside a top-level list whose items are wanted
  std::size_t member_begin_ = 0;  // end of its key
  std::size_t item_begin_ = 0;    // end of the item before
  std::uint64_t values_ = 0;      // in it, so far
};

}  // namespace

void walk_json(const std::string& text, const std::string& name, const JsonVisitor& visitor) { Walker(text, name, visitor).walk(); }

}  // namespace hooke
