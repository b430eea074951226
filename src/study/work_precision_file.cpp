#include "study/work_precision_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <map>
#include <set>

#include "base/csv_field.h"
#include "base/file_limits.h"
#include "base/json_field.h"
#include "base/json_text.h"
#include "base/json_writer.h"

namespace hooke {
namespace {

using Layout = JsonWriter::Layout;

const char* name_of(Measure measure) { return measure == Measure::Trajectory ? "trajectory" : "observables"; }

// The fields of each record, in the order of the file: for writing and for reading.
template <class Record, class Visit>
void visit_reference(Record& reference, const Visit& visit) {
  visit("method", reference.method);
  visit("setting", reference.setting);
  visit("own_gap", reference.own_gap);
  visit("other_method", reference.other_method);
  visit("other_setting", reference.other_setting);
  visit("other_own_gap", reference.other_own_gap);
  visit("other_gap", reference.other_gap);
  visit("amplification", reference.amplification);
  visit("judged_by", reference.measure);
}

template <class Record, class Visit>
void visit_row(Record& row, const Visit& visit) {
  visit("method", row.method);
  visit("setting", row.setting);
  visit("step_s", row.step);
  visit("tolerance_m", row.tolerance);
  visit("error_m", row.error);
  visit("relative_error", row.relative_error);
  visit("cpu_ms_per_s", row.cpu_ms_per_s);
  visit("runs", row.runs);
  visit("force_evaluations", row.work.force_evaluations);
  visit("factorizations", row.work.factorizations);
  visit("solves", row.work.solves);
  visit("sweeps", row.work.sweeps);
  visit("energy_drift", row.energy_drift);
  visit("strain_error", row.strain_error);
  visit("status", row.status);
}

// All but the fingerprint, the reference and the rows, which follow.
template <class Record, class Visit>
void visit_problem(Record& problem, const Visit& visit) {
  visit("scene", problem.id);
  visit("title", problem.title);
  visit("points", problem.points);
  visit("springs", problem.springs);
  visit("seconds", problem.seconds);
  visit("size_m", problem.size);
}

template <class Record, class Visit>
void visit_part(Record& part, const Visit& visit) {
  visit("of", part.of);
  visit("number", part.number);
  visit("count", part.count);
  visit("complete", part.is_complete);
}

// All but the parts and the problems, which follow.
template <class Record, class Visit>
void visit_results(Record& results, const Visit& visit) {
  visit("version", results.conditions.version);
  visit("build", results.conditions.build);
  visit("machine", results.conditions.machine);
  visit("effort", results.conditions.effort);
  visit("date", results.date);
}

class FieldWriter {
 public:
  explicit FieldWriter(JsonWriter& json) : json_(json) {}
  void operator()(const char* key, const std::string& text) const { json_.text(key, text); }
  void operator()(const char* key, const std::optional<double>& number) const { json_.number(key, number); }
  void operator()(const char* key, double number) const { json_.number(key, std::optional(number)); }
  void operator()(const char* key, std::integral auto number) const { json_.integer(key, static_cast<std::int64_t>(number)); }
  void operator()(const char* key, bool value) const { json_.boolean(key, value); }
  void operator()(const char* key, Measure measure) const { json_.text(key, name_of(measure)); }

 private:
  JsonWriter& json_;
};

// Reads the output of a FieldWriter; anything else is refused with the name of the field.
class FieldReader {
 public:
  explicit FieldReader(const JsonField& object) : object_(object) {}

  void operator()(const char* key, std::string& text) const { text = at(key).text(); }
  void operator()(const char* key, std::optional<double>& number) const {
    if (const JsonField field = at(key); !field.is_null()) number = field.number();
  }
  void operator()(const char* key, double& number) const {
    std::optional<double> known;
    (*this)(key, known);
    number = known.value_or(NAN);
  }
  void operator()(const char* key, std::integral auto& number) const {
    number = static_cast<std::decay_t<decltype(number)>>(at(key).integer(0, std::int64_t{1} << 53));
  }
  void operator()(const char* key, bool& is_set) const { is_set = at(key).boolean(); }
  void operator()(const char* key, Measure& measure) const {
    measure = at(key).text() == name_of(Measure::Trajectory) ? Measure::Trajectory : Measure::Observables;
  }
  // None: there is none of this name.
  std::optional<JsonField> find(const char* key) const {
    for (const JsonField member : object_.members())
      if (member.is(key)) return member;
    return std::nullopt;
  }
  JsonField at(const char* key) const {
    if (const auto member = find(key)) return *member;
    object_.refuse_missing(key, "not benchmark results");
  }

 private:
  const JsonField& object_;
};

// Calls `read` for every item of a list.
template <class Read>
void read_list(const JsonField& list, const Read& read) {
  for (const JsonField item : list.items(0, max_values_per_item)) read(item);
}

void write_problem(JsonWriter& json, const ProblemRecord& problem) {
  const FieldWriter fields(json);
  char print[17] = {};
  std::to_chars(print, print + 16, problem.fingerprint, 16);
  json.begin_object(Layout::Lines);
  visit_problem(problem, fields);
  json.text("fingerprint", print);
  if (problem.reference) {
    json.begin_object("reference", Layout::Lines);
    visit_reference(*problem.reference, fields);
    json.end();
  } else {
    json.null("reference");
  }
  json.objects("rows", problem.rows, [&](const Row& row) { visit_row(row, fields); });
  json.end();
}

ProblemRecord read_problem(const JsonField& object) {
  const FieldReader fields(object);
  ProblemRecord problem;
  visit_problem(problem, fields);
  std::string print;
  fields("fingerprint", print);
  std::from_chars(print.data(), print.data() + print.size(), problem.fingerprint, 16);
  if (const JsonField reference = fields.at("reference"); !reference.is_null())
    visit_reference(problem.reference.emplace(), FieldReader(reference));
  read_list(fields.at("rows"), [&](const JsonField& row) { visit_row(problem.rows.emplace_back(), FieldReader(row)); });
  return problem;
}

PartRecord read_part(const JsonField& object) {
  PartRecord part;
  visit_part(part, FieldReader(object));
  if (part.number < 1 || part.number > part.count || part.count > max_part_records)
    object.refuse("number must be from 1 to count, and count at most " + std::to_string(max_part_records));
  return part;
}

void append(std::string& line, const std::optional<double>& number) {
  line += ',';
  if (number && std::isfinite(*number)) line += format_exact(*number);
}

}  // namespace

std::string format_results(const Results& results) {
  JsonWriter json;
  const FieldWriter fields(json);
  json.begin_object(Layout::Lines);
  fields("hooke_bench", 1);
  visit_results(results, fields);
  if (!results.parts.empty()) json.objects("parts", results.parts, [&](const PartRecord& part) { visit_part(part, fields); });
  json.list("scenes", Layout::Lines, results.problems, [&](const ProblemRecord& problem) { write_problem(json, problem); });
  json.end();
  return json.take() + '\n';
}

Results parse_results(const std::string& text, const std::string& name) {
  const auto accept = [](auto&&...) {};
  walk_json(text, name, {.is_list = [](std::string_view key) { return key == "scenes"; }, .item = accept, .member = accept});
  JsonParser parser;
  const JsonField object(name, "results", parser.parse(text));
  const FieldReader fields(object);
  fields.at("hooke_bench");
  Results results;
  visit_results(results, fields);
  // earlier files have none
  if (const auto parts = fields.find("parts")) read_list(*parts, [&](const JsonField& part) { results.parts.push_back(read_part(part)); });
  read_list(fields.at("scenes"), [&](const JsonField& problem) { results.problems.push_back(read_problem(problem)); });
  return results;
}

std::string format_csv(const Results& results) {
  std::string text =
      "scene,method,setting,step_s,error_m,relative_error,cpu_ms_per_s,force_evaluations,factorizations,energy_drift,status\n";
  for (const ProblemRecord& record : results.problems)
    for (const Row& row : record.rows) {
      text += csv_field(record.id) + ',' + row.method + ',' + row.setting;
      append(text, row.step);
      append(text, row.error);
      append(text, row.relative_error);
      append(text, row.cpu_ms_per_s);
      text += ',' + std::to_string(row.work.force_evaluations) + ',' + std::to_string(row.work.factorizations);
      append(text, row.energy_drift);
      text += ',' + row.status + '\n';
    }
  return text;
}

namespace {

void add(ProblemRecord& record, const ProblemRecord& part) {
  if (!record.reference) record.reference = part.reference;
  for (const Row& row : part.rows) {
    const bool is_known =
        std::ranges::any_of(record.rows, [&](const Row& other) { return other.method == row.method && other.setting == row.setting; });
    if (!is_known) record.rows.push_back(row);
  }
}

// Built-in problems come in the order of their table, others after them in the order of the files.
std::size_t place_of(const ProblemRecord& record) {
  const auto table = built_in_problems();
  return static_cast<std::size_t>(std::ranges::find(table, record.id, &BuiltInProblem::id) - table.begin());
}

void add_parts(std::vector<PartRecord>& known, const std::vector<PartRecord>& parts) {
  for (const PartRecord& part : parts) {
    const auto same = std::ranges::find_if(known, [&](const PartRecord& other) { return other.is_same(part); });
    if (same == known.end())
      known.push_back(part);
    else
      same->is_complete = same->is_complete || part.is_complete;
  }
}

// Of scenes and methods that were divided in several ways, one that is complete is enough.
std::string describe_missing(const std::vector<PartRecord>& parts) {
  std::map<std::pair<std::string, std::size_t>, std::set<std::size_t>> finished;  // of the scenes and methods, and the number of parts
  std::set<std::string> complete;
  for (const PartRecord& part : parts) {
    std::set<std::size_t>& numbers = finished[{part.of, part.count}];
    if (part.is_complete) numbers.insert(part.number);
    if (numbers.size() == part.count) complete.insert(part.of);
  }
  for (const auto& [division, numbers] : finished) {
    const auto& [of, count] = division;
    if (complete.contains(of)) continue;
    std::size_t first = 1;
    while (numbers.contains(first)) ++first;
    const std::string all = std::to_string(count);
    return std::to_string(count - numbers.size()) + " of " + all + " shards are missing or not finished, the first is " +
           std::to_string(first) + '/' + all;
  }
  return {};
}

}  // namespace

MergedResults merge_results(const std::vector<std::pair<std::string, Results>>& parts) {
  Results merged;
  std::string unknown;
  for (const auto& [name, part] : parts) {
    if (&part == &parts.front().second) merged.conditions = part.conditions;
    if (part.conditions != merged.conditions)
      throw InputError(name + ": measured with another build, machine or effort than " + parts.front().first);
    merged.date = std::max(merged.date, part.date);
    if (part.parts.empty()) unknown = name + " does not say which shard it is";
    add_parts(merged.parts, part.parts);
    for (const ProblemRecord& problem : part.problems) {
      const auto known = std::ranges::find(merged.problems, problem.id, &ProblemRecord::id);
      if (known == merged.problems.end()) {
        merged.problems.push_back(problem);
        continue;
      }
      if (known->fingerprint != problem.fingerprint) throw InputError(name + ": " + problem.id + ": another scene of the same name");
      add(*known, problem);
    }
  }
  // rows of a method stay in their order, coarsest first
  for (ProblemRecord& record : merged.problems) std::ranges::stable_sort(record.rows, {}, method_index);
  std::ranges::stable_sort(merged.problems, {}, place_of);
  std::string missing = unknown.empty() ? describe_missing(merged.parts) : unknown;
  return {std::move(merged), std::move(missing)};
}

}  // namespace hooke
