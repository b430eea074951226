#include "study/work_precision_file.h"

#include <rapidjson/document.h>
#include <rapidjson/prettywriter.h>
#include <rapidjson/stringbuffer.h>

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>

#include "base/csv_field.h"

namespace hooke {
namespace {

using Writer = rapidjson::PrettyWriter<rapidjson::StringBuffer>;

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
  explicit FieldWriter(Writer& writer) : writer_(writer) {}

  void operator()(const char* key, const std::string& text) const {
    writer_.Key(key);
    writer_.String(text.data(), static_cast<rapidjson::SizeType>(text.size()));
  }
  void operator()(const char* key, std::optional<double> number) const {
    writer_.Key(key);
    if (number && std::isfinite(*number))
      writer_.Double(*number);
    else
      writer_.Null();
  }
  void operator()(const char* key, double number) const { (*this)(key, std::optional(number)); }
  void operator()(const char* key, std::integral auto number) const {
    writer_.Key(key);
    writer_.Int64(static_cast<std::int64_t>(number));
  }
  void operator()(const char* key, bool value) const {
    writer_.Key(key);
    writer_.Bool(value);
  }
  void operator()(const char* key, Measure measure) const { (*this)(key, std::string(name_of(measure))); }

 private:
  Writer& writer_;
};

// Reads the output of a FieldWriter; anything else is refused with the name of the field.
class FieldReader {
 public:
  FieldReader(const rapidjson::Value& object, const std::string& name) : object_(object), name_(name) {
    if (!object.IsObject()) refuse("an object is missing");
  }

  void operator()(const char* key, std::string& text) const {
    const rapidjson::Value& value = at(key);
    if (!value.IsString()) refuse(std::string(key) + ": not a string");
    text.assign(value.GetString(), value.GetStringLength());
  }
  void operator()(const char* key, std::optional<double>& number) const {
    const rapidjson::Value& value = at(key);
    if (value.IsNull()) return;
    if (!value.IsNumber()) refuse(std::string(key) + ": not a number");
    number = value.GetDouble();
  }
  void operator()(const char* key, double& number) const {
    std::optional<double> known;
    (*this)(key, known);
    number = known.value_or(NAN);
  }
  void operator()(const char* key, std::integral auto& number) const {
    const rapidjson::Value& value = at(key);
    if (!value.IsInt64()) refuse(std::string(key) + ": not a whole number");
    number = static_cast<std::decay_t<decltype(number)>>(value.GetInt64());
  }
  void operator()(const char* key, bool& is_set) const {
    const rapidjson::Value& value = at(key);
    if (!value.IsBool()) refuse(std::string(key) + ": not true or false");
    is_set = value.GetBool();
  }
  void operator()(const char* key, Measure& measure) const {
    std::string text;
    (*this)(key, text);
    measure = text == name_of(Measure::Trajectory) ? Measure::Trajectory : Measure::Observables;
  }
  bool has(const char* key) const { return object_.HasMember(key); }
  const rapidjson::Value& list(const char* key) const {
    const rapidjson::Value& value = at(key);
    if (!value.IsArray()) refuse(std::string(key) + ": not a list");
    return value;
  }
  std::optional<FieldReader> object(const char* key) const {
    const rapidjson::Value& value = at(key);
    if (value.IsNull()) return std::nullopt;
    return FieldReader(value, name_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const { throw InputError(name_ + ": " + why + ": not benchmark results"); }
  const rapidjson::Value& at(const char* key) const {
    const auto member = object_.FindMember(key);
    if (member == object_.MemberEnd()) refuse(std::string(key) + ": missing");
    return member->value;
  }

  const rapidjson::Value& object_;
  const std::string& name_;
};

void write_problem(Writer& writer, const ProblemRecord& problem) {
  const FieldWriter fields(writer);
  char print[17] = {};
  std::to_chars(print, print + 16, problem.fingerprint, 16);
  writer.StartObject();
  visit_problem(problem, fields);
  fields("fingerprint", std::string(print));
  writer.Key("reference");
  if (problem.reference) {
    writer.StartObject();
    visit_reference(*problem.reference, fields);
    writer.EndObject();
  } else {
    writer.Null();
  }
  writer.Key("rows");
  writer.StartArray();
  for (const Row& row : problem.rows) {
    writer.StartObject();
    visit_row(row, fields);
    writer.EndObject();
  }
  writer.EndArray();
  writer.EndObject();
}

ProblemRecord read_problem(const FieldReader& fields, const std::string& name) {
  ProblemRecord problem;
  visit_problem(problem, fields);
  std::string print;
  fields("fingerprint", print);
  std::from_chars(print.data(), print.data() + print.size(), problem.fingerprint, 16);
  if (const std::optional<FieldReader> reference = fields.object("reference")) visit_reference(problem.reference.emplace(), *reference);
  for (const rapidjson::Value& row : fields.list("rows").GetArray()) visit_row(problem.rows.emplace_back(), FieldReader(row, name));
  return problem;
}

PartRecord read_part(const FieldReader& fields, const std::string& name) {
  PartRecord part;
  visit_part(part, fields);
  if (part.number < 1 || part.number > part.count || part.count > max_part_records)
    throw InputError(name + ": parts: number must be from 1 to count, and count at most " + std::to_string(max_part_records));
  return part;
}

// the shortest digits that read back as the same number
void append(std::string& line, std::optional<double> number) {
  line += ',';
  if (!number || !std::isfinite(*number)) return;
  char text[32];
  line.append(text, std::to_chars(text, text + sizeof text, *number).ptr);
}

}  // namespace

std::string format_results(const Results& results) {
  rapidjson::StringBuffer buffer;
  Writer writer(buffer);
  writer.SetIndent(' ', 1);
  const FieldWriter fields(writer);
  writer.StartObject();
  fields("hooke_bench", 1);
  visit_results(results, fields);
  if (!results.parts.empty()) {
    writer.Key("parts");
    writer.StartArray();
    for (const PartRecord& part : results.parts) {
      writer.StartObject();
      visit_part(part, fields);
      writer.EndObject();
    }
    writer.EndArray();
  }
  writer.Key("scenes");
  writer.StartArray();
  for (const ProblemRecord& problem : results.problems) write_problem(writer, problem);
  writer.EndArray();
  writer.EndObject();
  return std::string(buffer.GetString(), buffer.GetSize()) + '\n';
}

Results parse_results(const std::string& text, const std::string& name) {
  rapidjson::Document document;
  document.Parse<rapidjson::kParseIterativeFlag | rapidjson::kParseFullPrecisionFlag | rapidjson::kParseValidateEncodingFlag>(text.data(),
                                                                                                                              text.size());
  if (document.HasParseError())
    throw InputError(name + ": byte " + std::to_string(document.GetErrorOffset()) + ": not JSON: not benchmark results");
  const FieldReader fields(document, name);
  long version = 0;
  fields("hooke_bench", version);
  Results results;
  visit_results(results, fields);
  // earlier files have none
  if (fields.has("parts"))
    for (const rapidjson::Value& part : fields.list("parts").GetArray()) results.parts.push_back(read_part(FieldReader(part, name), name));
  for (const rapidjson::Value& problem : fields.list("scenes").GetArray())
    results.problems.push_back(read_problem(FieldReader(problem, name), name));
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

}  // namespace hooke
