#include "formats/xsp/xsp_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include "base/bounds.h"
#include "base/errors.h"
#include "base/file_limits.h"
#include "base/printable.h"
#include "base/text_lines.h"

namespace hooke {
namespace {

constexpr std::string_view header = "#1.0";
constexpr std::size_t max_quoted = 40;  // bytes of an invalid value in a message
constexpr std::size_t max_forces = 1000;

// The range of an argument of a command.
enum class Range { Any, Integer, Id, NotNegative, Positive };

std::string_view text_of(Range range) {
  constexpr std::array<std::string_view, 5> texts{"must be a number", "must be a whole number",
                                                  "must be a whole number from 1 to 2147483647", "must be at least 0",
                                                  "must be more than 0"};
  return texts[static_cast<std::size_t>(range)];
}

bool is_in_range(Range range, double value) {
  const bool is_integer = value == std::trunc(value) && std::abs(value) <= std::numeric_limits<int>::max();
  if (range == Range::Integer || range == Range::Id) return is_integer && (range == Range::Integer || value >= 1.0);
  return range == Range::Any || value > 0.0 || (range == Range::NotNegative && value == 0.0);
}

struct Argument {
  std::string_view name;
  Range range = Range::Any;
};

struct Values {
  int line;
  std::span<const double> numbers;
  double operator[](std::size_t i) const { return numbers[i]; }
  int integer(std::size_t i) const { return static_cast<int>(numbers[i]); }
  bool flag(std::size_t i) const { return numbers[i] != 0.0; }
};

struct Statement {
  std::string_view name;
  std::vector<Argument> arguments;
  bool is_setting;  // a setting, not one of a list
  void (*apply)(XspDocument& document, const Values& values);
};

// The format: one row per command.
const std::vector<Statement>& statements() {
  using D = XspDocument;
  using V = Values;
  static const std::vector<Statement> rows{
      {"cmas", {{"mass"}}, true, [](D& d, const V& v) { d.new_mass = v[0]; }},
      {"elas", {{"elasticity"}}, true, [](D& d, const V& v) { d.new_elasticity = v[0]; }},
      {"kspr", {{"k"}}, true, [](D& d, const V& v) { d.new_stiffness = v[0]; }},
      {"kdmp", {{"damping"}}, true, [](D& d, const V& v) { d.new_damping = v[0]; }},
      {"fixm", {{"fixed"}}, true, [](D& d, const V& v) { d.new_masses_fixed = v.flag(0); }},
      {"shws", {{"shown"}}, true, [](D& d, const V& v) { d.springs_shown = v.flag(0); }},
      {"cent", {{"mass id", Range::Integer}}, true, [](D& d, const V& v) { d.center = v.integer(0); }},
      {"frce",
       {{"force id", Range::Integer}, {"active"}, {"p1"}, {"p2"}},
       false,
       [](D& d, const V& v) {
         d.forces[v.integer(0)] = {v.flag(1), v[2], v[3]};
       }},
      {"visc", {{"viscosity", Range::NotNegative}}, true, [](D& d, const V& v) { d.viscosity = v[0]; }},
      {"stck", {{"stickiness"}}, true, [](D& d, const V& v) { d.stickiness = v[0]; }},
      {"step", {{"step", Range::Positive}}, true, [](D& d, const V& v) { d.step = v[0]; }},
      {"prec", {{"precision"}}, true, [](D& d, const V& v) { d.precision = v[0]; }},
      {"adpt", {{"adaptive"}}, true, [](D& d, const V& v) { d.adaptive = v.flag(0); }},
      {"gsnp",
       {{"grid"}, {"snaps"}},
       true,
       [](D& d, const V& v) {
         d.grid = v[0];
         d.snap_to_grid = v.flag(1);
       }},
      {"wall",
       {{"top"}, {"left"}, {"right"}, {"bottom"}},
       true,
       [](D& d, const V& v) {
         d.walls = {v.flag(0), v.flag(1), v.flag(2), v.flag(3)};
       }},
      {"mass",
       {{"id", Range::Id}, {"x"}, {"y"}, {"vx"}, {"vy"}, {"mass"}, {"elasticity"}},
       false,
       [](D& d, const V& v) {
         d.masses.push_back({v.line, v.integer(0), v[1], v[2], v[3], v[4], v[5], v[6]});
       }},
      {"spng",
       {{"id", Range::Id},
        {"first mass", Range::Id},
        {"second mass", Range::Id},
        {"k", Range::NotNegative},
        {"damping", Range::NotNegative},
        {"rest length", Range::NotNegative}},
       false,
       [](D& d, const V& v) {
         d.springs.push_back({v.line, v.integer(0), v.integer(1), v.integer(2), v[3], v[4], v[5]});
       }},
  };
  return rows;
}

class Reader {
 public:
  explicit Reader(const std::string& file) : file_(file) {}

  XspDocument read(std::string_view text) {
    TextLines lines(text);
    std::string_view line;
    if (!lines.next(line) || line.substr(0, header.size()) != header)
      throw InputError(line_location(file_, 1) + ": \"" + printable(line, max_quoted) + "\": must begin with " + std::string(header));
    while (lines.next(line)) {
      line_ = lines.number();
      read_line(line);
    }
    check_ids();
    warn_of_first(unknown_, "more line is", "more lines are", " not a command, kept");
    warn_of_first(unconnected_, "more spring lacks", "more springs lack", " a mass: ignored");
    return std::move(document_);
  }

 private:
  void read_line(std::string_view line) {
    const std::string_view whole_line = line;
    const std::string_view name = next_token(line);
    if (name.empty() || name[0] == '#') return;
    const auto statement = std::find_if(statements().begin(), statements().end(), [&](const Statement& row) { return row.name == name; });
    if (statement == statements().end()) {
      unknown_.push_back("line " + std::to_string(line_) + ": " + printable(name, max_quoted) + ": is not a command, kept");
      document_.unknown.push_back(printable(whole_line));
      return;
    }
    refuse_dialect(name, line);

    std::array<double, 8> numbers;
    std::size_t count = 0;
    for (const Argument& argument : statement->arguments) numbers[count++] = read_number(next_token(line), *statement, argument);
    const std::string_view more = next_token(line);
    if (!more.empty()) refuse(line_, std::string(name) + ": \"" + printable(more, max_quoted) + "\"", "is a surplus value");

    record_repetition(*statement, numbers[0]);
    statement->apply(document_, {line_, {numbers.data(), count}});
    if (document_.forces.size() > max_forces) refuse(line_, "frce", "must be at most " + std::to_string(max_forces));
    if (document_.masses.size() > max_points) refuse(line_, "mass", "must be at most " + std::to_string(max_points));
    if (document_.springs.size() > max_springs) refuse(line_, "spng", "must be at most " + std::to_string(max_springs));
  }

  // GoSpringies names its forces, and its masses have no velocity.
  void refuse_dialect(std::string_view name, std::string_view line) const {
    std::size_t words = 0;
    const std::string_view first = next_token(line);
    for (std::string_view word = first; !word.empty(); word = next_token(line)) ++words;
    const bool is_named_force =
        name == "frce" && !first.empty() && !parse_number(first) && std::isalpha(static_cast<unsigned char>(first[0]));
    if (is_named_force || (name == "mass" && words == 5))
      refuse(line_, std::string(name) + (is_named_force ? " " + printable(first, max_quoted) : ""),
             "is the dialect of GoSpringies: must be a file of XSpringies");
  }

  double read_number(std::string_view word, const Statement& statement, const Argument& argument) const {
    const auto value = parse_number(word);
    if (value && is_in_range(argument.range, *value)) return *value;
    const std::string what = std::string(statement.name) + ": " + std::string(argument.name);
    if (word.empty()) refuse(line_, what, "is missing");
    refuse(line_, what + ": \"" + printable(word, max_quoted) + "\"", text_of(value ? argument.range : Range::Any));
  }

  void record_repetition(const Statement& statement, double id) {
    constexpr std::size_t max_repetitions = 20;
    const bool is_force = statement.name == "frce";
    if (!statement.is_setting && !is_force) return;
    const bool repeated = is_force ? document_.forces.contains(static_cast<int>(id)) : !seen_.insert(statement.name).second;
    if (repeated && document_.warnings.size() < max_repetitions)
      document_.warnings.push_back("line " + std::to_string(line_) + ": " + std::string(statement.name) +
                                   ": already set before; the last value is used");
  }

  // Removes springs to masses that are not in the file.
  void check_ids() {
    const std::set<int> masses = check_unique(document_.masses, "mass");
    check_unique(document_.springs, "spng");
    std::erase_if(document_.springs, [&](const XspSpring& spring) {
      const std::string name = "spng: " + std::to_string(spring.id) + ": mass ";
      for (const int id : {spring.first, spring.second})
        if (!masses.contains(id)) {
          unconnected_.push_back("line " + std::to_string(spring.line) + ": " + name + std::to_string(id) +
                                 ": is not in the file: ignored");
          return true;
        }
      if (spring.first == spring.second) refuse(spring.line, name + std::to_string(spring.first), "must not be connected to itself");
      return false;
    });
  }

  // One warning for all of a kind.
  void warn_of_first(const std::vector<std::string>& all, const std::string& one, const std::string& many, const std::string& what) {
    if (!all.empty()) document_.warnings.push_back(all[0]);
    if (all.size() > 1) document_.warnings.push_back(pluralize(all.size() - 1, one, many) + what);
  }

  template <class Item>
  std::set<int> check_unique(const std::vector<Item>& items, std::string_view command) const {
    std::set<int> ids;
    for (const Item& item : items)
      if (!ids.insert(item.id).second) refuse(item.line, std::string(command) + ": id: " + std::to_string(item.id), "is already used");
    return ids;
  }

  [[noreturn]] void refuse(int line, const std::string& what, std::string_view limit) const {
    throw InputError(line_location(file_, line) + ": " + what + ": " + std::string(limit));
  }

  const std::string& file_;
  XspDocument document_;
  std::set<std::string_view> seen_;
  std::vector<std::string> unknown_, unconnected_;  // sentences
  int line_ = 0;
};

std::string text_of(double value) { return format_exact(value); }
std::string text_of(int value) { return std::to_string(value); }
std::string text_of(bool value) { return value ? "1" : "0"; }

// "NAME a b c\n"
template <class... Values>
void add_line(std::string& text, std::string_view name, Values... values) {
  text += name;
  ((text += ' ', text += text_of(values)), ...);
  text += '\n';
}

}  // namespace

XspDocument parse_xsp_text(std::string_view text, const std::string& file) { return Reader(file).read(text); }

std::string format_xsp_text(const XspDocument& document) {
  const XspDocument& d = document;
  std::string text(header);
  text += " written by Hooke\n";
  add_line(text, "cmas", d.new_mass);
  add_line(text, "elas", d.new_elasticity);
  add_line(text, "kspr", d.new_stiffness);
  add_line(text, "kdmp", d.new_damping);
  add_line(text, "fixm", d.new_masses_fixed);
  add_line(text, "shws", d.springs_shown);
  add_line(text, "cent", d.center);
  for (const auto& [id, force] : d.forces) add_line(text, "frce", id, force.active, force.p1, force.p2);
  add_line(text, "visc", d.viscosity);
  add_line(text, "stck", d.stickiness);
  add_line(text, "step", d.step);
  add_line(text, "prec", d.precision);
  add_line(text, "adpt", d.adaptive);
  add_line(text, "gsnp", d.grid, d.snap_to_grid);
  add_line(text, "wall", d.walls[0], d.walls[1], d.walls[2], d.walls[3]);
  for (const XspMass& m : d.masses) add_line(text, "mass", m.id, m.x, m.y, m.vx, m.vy, m.mass, m.elasticity);
  for (const XspSpring& s : d.springs) add_line(text, "spng", s.id, s.first, s.second, s.stiffness, s.damping, s.rest_length);
  for (const std::string& line : d.unknown) text += line + "\n";
  return text;
}

}  // namespace hooke
