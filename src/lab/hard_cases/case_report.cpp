#include "lab/hard_cases/case_report.h"

#include <algorithm>

#include "lab/json_writer.h"

namespace hooke {
namespace {

// The results of one case stand one after another.
std::vector<std::span<const CaseResult>> by_case(std::span<const CaseResult> results) {
  std::vector<std::span<const CaseResult>> groups;
  for (std::size_t begin = 0, end = 0; begin < results.size(); begin = end) {
    while (end < results.size() && results[end].hard_case == results[begin].hard_case) ++end;
    groups.push_back(results.subspan(begin, end - begin));
  }
  return groups;
}

// In the order of the results, each once.
std::vector<const Integrator*> methods_of(std::span<const CaseResult> results) {
  std::vector<const Integrator*> methods;
  for (const CaseResult& result : results)
    if (result.method != nullptr && std::ranges::find(methods, result.method) == methods.end()) methods.push_back(result.method);
  return methods;
}

std::string_view id_of(const CaseResult& result) { return result.method != nullptr ? result.method->id : "any"; }

char mark_of(const Verdict& verdict) {
  if (is_broken(verdict)) return '!';
  switch (verdict.outcome) {
    case Outcome::Held: return '+';
    case Outcome::FailedOpenly: return 'o';
    case Outcome::FailedSilently: return '!';
    case Outcome::OutOfScope: return '-';
  }
  return '?';
}

std::string joined(const std::string& first, const std::string& second) {
  return first + (first.empty() || second.empty() ? "" : "; ") + second;
}

std::string count_in_words(std::span<const CaseResult> results) {
  const auto count = [&](Outcome outcome) {
    return std::ranges::count_if(results, [&](const CaseResult& r) { return r.verdict.outcome == outcome && !is_broken(r.verdict); });
  };
  const int broken = count_broken(results);
  return std::to_string(results.size()) + " results: " + std::to_string(count(Outcome::Held)) + " held, " +
         std::to_string(count(Outcome::FailedOpenly)) + " failed openly, " + std::to_string(count(Outcome::OutOfScope)) +
         " out of scope, " + (broken == 0 ? "none" : std::to_string(broken)) + " against expectation";
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string two_digits(int number) { return (number < 10 ? " " : "") + std::to_string(number); }

}  // namespace

std::string format_table(std::span<const CaseResult> results) {
  constexpr std::size_t name_width = 32;
  const std::vector<const Integrator*> methods = methods_of(results);
  std::string table = "+ held   o failed openly   - out of scope   ! against expectation\n\n";
  for (std::size_t m = 0; m < methods.size(); ++m)
    table += padded("", name_width) + [&] {
      std::string bars;
      for (std::size_t i = 0; i < m; ++i) bars += "| ";
      return bars;
    }() + std::string(methods[m]->id) + "\n";

  for (const auto& group : by_case(results)) {
    table += padded(two_digits(group[0].hard_case->number) + " " + std::string(group[0].hard_case->name), name_width);
    for (const CaseResult& result : group) {
      table += mark_of(result.verdict);
      table += result.method == nullptr ? " (no method's own)" : " ";
    }
    table += "\n";
  }

  table += "\n";
  for (const CaseResult& result : results)
    if (is_broken(result.verdict))
      table += "! " + std::to_string(result.hard_case->number) + " " + std::string(result.hard_case->name) + ", " + std::string(id_of(result)) +
               ": " + std::string(describe(result.verdict.outcome)) + ", expected to " + std::string(describe(result.verdict.expected)) +
               "; " + joined(result.verdict.measured, result.verdict.reason) + "\n";
  return table + count_in_words(results) + "\n";
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
  json.key("cases");
  json.begin_list(Layout::Lines);
  for (const auto& group : by_case(results)) {
    const HardCase& hard_case = *group[0].hard_case;
    json.begin_object(Layout::Lines);
    json.whole("number", hard_case.number);
    json.text("name", hard_case.name);
    json.text("parameters", hard_case.parameters);
    json.text("criterion", hard_case.criterion);
    json.text("not_built", hard_case.not_built);
    json.key("results");
    json.begin_list(Layout::Lines);
    for (const CaseResult& result : group) {
      json.begin_object(Layout::Line);
      json.text("method", id_of(result));
      json.text("outcome", underscored(describe(result.verdict.outcome)));
      json.text("expected", underscored(describe(result.verdict.expected)));
      json.boolean("broken", is_broken(result.verdict));
      json.text("measured", result.verdict.measured);
      json.text("reason", result.verdict.reason);
      json.number("cpu_seconds", result.cpu_seconds);
      json.end();
    }
    json.end();
    json.end();
  }
  json.end();
  json.whole("broken", count_broken(results));
  json.end();
  return json.written() + "\n";
}

namespace {

constexpr std::string_view introduction = R"(# Stability: the hard cases

Scenes on which methods for springs are known to fail, and what became of each method in them. Made by

    hooke check --hard --markdown docs/stability.md

from the table in `src/lab/hard_cases/hard_cases.cpp`, where the cases stand, and the table of methods. A result is

* **held**: the criterion was met;
* **failed openly**: it was not, and the run said so. By the watch for divergence, which stops it, keeps the last good
  state, and names the point, the spring, and what would hold; by the status, which says that the step is beyond the
  method's limit; by solves that did not converge; by an energy balance that does not close; or by the estimate of the
  error, which does a frame again with half the step;
* **out of scope**: not a question to this method, for the reason given.

No method may fail in silence: `hooke check --hard` then ends with exit code 1, and so it does when a method fails that
declares that it can do it. One that steps beyond its own limit may fail, and so may one that holds for each spring alone
but promises nothing of many together (XPBD).

)";

std::string_view short_word(const Verdict& verdict) {
  if (is_broken(verdict)) return "**against expectation**";
  switch (verdict.outcome) {
    case Outcome::Held: return "held";
    case Outcome::FailedOpenly: return "*open*";
    case Outcome::FailedSilently: return "**silent**";
    case Outcome::OutOfScope: return "-";
  }
  return {};
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
    for (std::size_t i = 0; i < methods.size(); ++i)
      rows += " " + std::string(short_word(group[std::min(i, group.size() - 1)].verdict)) + " |";
    rows += "\n";
  }
  return "## All at once\n\n" + head + "\n" + rule + "\n" + rows + "\n" + count_in_words(results) + ".\n";
}

std::string format_case(std::span<const CaseResult> group) {
  const HardCase& hard_case = *group[0].hard_case;
  std::string section = "\n## " + std::to_string(hard_case.number) + ". " + std::string(hard_case.name) + "\n\n";
  section += "Scene: " + std::string(hard_case.parameters) + ".\n\nCriterion: " + std::string(hard_case.criterion) + ".\n\n";
  if (!hard_case.not_built.empty()) section += "Out of scope, because it does not exist yet: " + std::string(hard_case.not_built) + ".\n\n";
  section += "| method | result | measured | reported by |\n|---|---|---|---|\n";
  for (const CaseResult& result : group)
    section += "| " + std::string(id_of(result)) + " | " + std::string(describe(result.verdict.outcome)) + " | " + result.verdict.measured +
               " | " + result.verdict.reason + " |\n";
  return section;
}

}  // namespace

std::string format_markdown(std::span<const CaseResult> results) {
  std::string document(introduction);
  document += format_overview(results);
  for (const auto& group : by_case(results)) document += format_case(group);
  return document;
}

}  // namespace hooke
