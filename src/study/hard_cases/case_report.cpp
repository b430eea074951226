#include "study/hard_cases/case_report.h"

#include <algorithm>

#include "base/json_writer.h"
#include "sim/control/automatic.h"
#include "study/hard_cases/case_groups.h"

namespace hooke {

std::vector<std::span<const CaseResult>> by_case(std::span<const CaseResult> results) {
  std::vector<std::span<const CaseResult>> groups;
  for (std::size_t begin = 0, end = 0; begin < results.size(); begin = end) {
    while (end < results.size() && results[end].hard_case == results[begin].hard_case) ++end;
    groups.push_back(results.subspan(begin, end - begin));
  }
  return groups;
}

std::vector<const Integrator*> methods_of(std::span<const CaseResult> results) {
  std::vector<const Integrator*> methods;
  for (const Integrator& method : integrators())
    if (std::ranges::any_of(results, [&](const CaseResult& result) { return result.method == &method; })) methods.push_back(&method);
  if (std::ranges::any_of(results, [](const CaseResult& result) { return result.method == &automatic_method(); }))
    methods.push_back(&automatic_method());
  return methods;
}

const CaseResult* find_result(std::span<const CaseResult> group, const Integrator& method) {
  for (const CaseResult& result : group)
    if (result.method == nullptr || result.method == &method) return &result;
  return nullptr;
}

std::string_view id_of(const CaseResult& result) { return result.method != nullptr ? result.method->id : "any"; }

std::string summarize_counts(std::span<const CaseResult> results) {
  const auto count = [&](auto&& is_one) { return std::to_string(std::ranges::count_if(results, is_one)); };
  const auto with = [&](Outcome outcome) {
    return count([=](const CaseResult& r) { return r.finished && r.verdict.outcome == outcome && !is_broken(r.verdict); });
  };
  const int broken = count_broken(results);
  const std::string unfinished = count([](const CaseResult& r) { return !r.finished; });
  return std::to_string(results.size()) + " results: " + with(Outcome::Held) + " held, " + with(Outcome::FailedOpenly) +
         " failed openly, " + with(Outcome::OutOfScope) + " out of scope, " + (broken == 0 ? "none" : std::to_string(broken)) +
         " unexpected" + (unfinished == "0" ? "" : ", " + unfinished + " not run");
}

namespace {

// Up to this number of results, each is reported in full.
constexpr std::size_t full_listing_limit = 30;

char mark_of(const CaseResult* result) {
  if (result == nullptr || !result->finished) return ' ';
  if (is_broken(result->verdict)) return '!';
  switch (result->verdict.outcome) {
    case Outcome::Held:
      return '+';
    case Outcome::FailedOpenly:
      return 'o';
    case Outcome::FailedSilently:
      return '!';
    case Outcome::OutOfScope:
      return '-';
  }
  return '?';
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

// Wrapped to the width of a terminal; continuation lines are indented.
std::string wrapped(std::string_view text, std::size_t indent) {
  std::string lines, line;
  bool has_words = false;
  const auto end_line = [&] {
    lines += line + "\n";
    line.assign(indent, ' ');
    has_words = false;
  };
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (has_words && line.size() + 1 + word.size() > table_width) end_line();
    if (has_words) line += ' ';
    line += word;
    has_words = true;
  }
  return lines + line + "\n";
}

std::string format_full_result(const CaseResult& result) {
  const Verdict& verdict = result.verdict;
  std::string sentence = std::string(1, mark_of(&result)) + " " + std::to_string(result.hard_case->number) + " " +
                         std::string(result.hard_case->name) + ", " + std::string(id_of(result)) + ": " +
                         std::string(describe(verdict.outcome));
  if (is_broken(verdict)) sentence += ", expected to " + std::string(describe(verdict.expected));
  for (const std::string& part : {verdict.measured, verdict.reason})
    if (!part.empty()) sentence += "; " + part;
  return wrapped(sentence, 4);
}

}  // namespace

std::string format_table(std::span<const CaseResult> results) {
  constexpr std::size_t name_width = 32;
  const std::vector<const Integrator*> methods = methods_of(results);
  std::string table = "+ held   o failed openly   - out of scope   ! unexpected\n\n";
  for (std::size_t m = 0; m < methods.size(); ++m) {
    table += padded("", name_width);
    for (std::size_t i = 0; i < m; ++i) table += "| ";
    table += std::string(methods[m]->id) + "\n";
  }

  for (const auto& group : by_case(results)) {
    const HardCase& hard_case = *group[0].hard_case;
    const std::string number = (hard_case.number < 10 ? " " : "") + std::to_string(hard_case.number);
    std::string line = padded(number + " " + std::string(hard_case.name), name_width);
    if (group[0].method == nullptr)
      line += std::string(1, mark_of(&group[0])) + " (independent of the method)";
    else
      for (const Integrator* method : methods) line += std::string(1, mark_of(find_result(group, *method))) + " ";
    line.erase(line.find_last_not_of(' ') + 1);
    table += line + "\n";
  }

  table += "\n";
  for (const CaseResult& result : results)
    if (result.finished && (results.size() <= full_listing_limit || is_broken(result.verdict))) table += format_full_result(result);
  return table + wrapped(summarize_counts(results), 4);
}

namespace {

std::string underscored(std::string_view words) {
  std::string id(words);
  std::ranges::replace(id, ' ', '_');
  return id;
}

void write_rows(JsonWriter& json, const std::vector<std::vector<std::string>>& rows) {
  json.key("rows");
  json.begin_list(JsonWriter::Layout::Line);
  for (const auto& row : rows) {
    json.begin_list(JsonWriter::Layout::Line);
    for (const std::string& cell : row) json.text(cell);
    json.end();
  }
  json.end();
}

}  // namespace

std::string format_json(std::span<const CaseResult> results) {
  using Layout = JsonWriter::Layout;
  JsonWriter json;
  json.begin_object(Layout::Lines);
  json.key("cases");
  json.begin_list(Layout::Lines);
  for (const auto& group : by_case(results)) {
    const HardCase& hard_case = *group[0].hard_case;
    json.begin_object(Layout::Lines);
    json.integer("number", hard_case.number);
    json.text("name", hard_case.name);
    json.text("parameters", hard_case.parameters);
    json.text("criterion", hard_case.criterion);
    json.text("remark", hard_case.remark);
    if (!hard_case.columns.empty()) json.text("columns", hard_case.columns);
    json.key("results");
    json.begin_list(Layout::Lines);
    for (const CaseResult& result : group) {
      if (!result.finished) continue;
      json.begin_object(Layout::Line);
      json.text("method", id_of(result));
      json.text("outcome", underscored(describe(result.verdict.outcome)));
      json.text("expected", underscored(describe(result.verdict.expected)));
      json.boolean("broken", is_broken(result.verdict));
      json.text("measured", result.verdict.measured);
      json.text("reason", result.verdict.reason);
      json.number("cpu_seconds", result.cpu_seconds);
      if (!hard_case.columns.empty()) write_rows(json, result.verdict.rows);
      json.end();
    }
    json.end();
    json.end();
  }
  json.end();
  json.integer("broken", count_broken(results));
  json.integer("unfinished", std::ranges::count_if(results, [](const CaseResult& result) { return !result.finished; }));
  json.end();
  return json.written() + "\n";
}

}  // namespace hooke
