#include "study/hard_cases/case_report.h"

#include <algorithm>
#include <array>

#include "base/json_writer.h"
#include "sim/control/automatic.h"

namespace hooke {
namespace {

// Groups results; those of one case must be adjacent.
std::vector<std::span<const CaseResult>> by_case(std::span<const CaseResult> results) {
  std::vector<std::span<const CaseResult>> groups;
  for (std::size_t begin = 0, end = 0; begin < results.size(); begin = end) {
    while (end < results.size() && results[end].hard_case == results[begin].hard_case) ++end;
    groups.push_back(results.subspan(begin, end - begin));
  }
  return groups;
}

// The methods that have results, in table order.
std::vector<const Integrator*> methods_of(std::span<const CaseResult> results) {
  std::vector<const Integrator*> methods;
  for (const Integrator& method : integrators())
    if (std::ranges::any_of(results, [&](const CaseResult& result) { return result.method == &method; })) methods.push_back(&method);
  if (std::ranges::any_of(results, [](const CaseResult& result) { return result.method == &automatic_method(); }))
    methods.push_back(&automatic_method());
  return methods;
}

// The result of a method within one case. Null: none.
const CaseResult* find_result(std::span<const CaseResult> group, const Integrator& method) {
  for (const CaseResult& result : group)
    if (result.method == &method) return &result;
  return nullptr;
}

// "27 results: 20 held, ..."
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

// Up to this number of results, each is reported in full.
constexpr std::size_t full_listing_limit = 30;

char mark_of(const CaseResult* result) {
  if (result == nullptr || !result->finished) return ' ';
  if (is_broken(result->verdict)) return '!';
  return "+o!-"[static_cast<std::size_t>(result->verdict.outcome)];
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
                         std::string(result.hard_case->name) + ", " + std::string(result.method->id) + ": " +
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

}  // namespace

std::string format_json(std::span<const CaseResult> results) {
  using Layout = JsonWriter::Layout;
  JsonWriter json;
  json.begin_object(Layout::Lines);
  json.list("cases", Layout::Lines, by_case(results), [&](const auto& group) {
    const HardCase& hard_case = *group[0].hard_case;
    json.begin_object(Layout::Lines);
    json.integer("number", hard_case.number);
    json.text("name", hard_case.name);
    json.text("parameters", hard_case.parameters);
    json.text("criterion", hard_case.criterion);
    json.text("remark", hard_case.remark);
    json.list("results", Layout::Lines, group, [&](const CaseResult& result) {
      if (!result.finished) return;
      json.begin_object(Layout::Line);
      json.text("method", result.method->id);
      json.text("outcome", underscored(describe(result.verdict.outcome)));
      json.text("expected", underscored(describe(result.verdict.expected)));
      json.boolean("broken", is_broken(result.verdict));
      json.text("measured", result.verdict.measured);
      json.text("reason", result.verdict.reason);
      json.number("cpu_seconds", result.cpu_seconds);
      json.end();
    });
    json.end();
  });
  json.integer("broken", count_broken(results));
  json.integer("unfinished", std::ranges::count_if(results, [](const CaseResult& result) { return !result.finished; }));
  json.boolean("interrupted", !std::ranges::all_of(results, &CaseResult::finished));
  json.end();
  return json.written() + "\n";
}

namespace {

std::string_view outcome_label(const CaseResult* result) {
  if (result == nullptr || !result->finished) return "";
  if (is_broken(result->verdict)) return "**unexpected**";
  constexpr std::array<std::string_view, 4> labels{"held", "*open*", "**silent**", "-"};
  return labels[static_cast<std::size_t>(result->verdict.outcome)];
}

std::string format_overview(std::span<const CaseResult> results) {
  const std::vector<const Integrator*> methods = methods_of(results);
  std::string head = "| case |", rule = "|---|";
  for (const Integrator* method : methods) {
    head += " " + std::string(method->id) + " |";
    rule += "---|";
  }
  std::string rows;
  for (const auto& group : by_case(results)) {
    rows += "| " + std::to_string(group[0].hard_case->number) + " " + std::string(group[0].hard_case->name) + " |";
    for (const Integrator* method : methods) rows += " " + std::string(outcome_label(find_result(group, *method))) + " |";
    rows += "\n";
  }
  return "\n" + head + "\n" + rule + "\n" + rows + "\n" + summarize_counts(results) + ".\n";
}

// One row for each case: its scene, and the criterion with which it counts as held.
std::string format_cases(std::span<const CaseResult> results) {
  std::string table = "\n| case | scene | held if | remark |\n|---|---|---|---|\n";
  for (const auto& group : by_case(results)) {
    const HardCase& hard_case = *group[0].hard_case;
    table += "| " + std::to_string(hard_case.number) + " | " + std::string(hard_case.parameters) + " | " +
             std::string(hard_case.criterion) + " | " + std::string(hard_case.remark) + " |\n";
  }
  return table;
}

}  // namespace

std::string format_markdown(std::span<const CaseResult> results, const Origin& origin) {
  return "Measured on " + origin.date + ", on one " + origin.machine + ", with `" + origin.command + "`.\n" + format_overview(results) +
         format_cases(results);
}

}  // namespace hooke
