#include "study/work_precision_file.h"

#include <rapidjson/document.h>
#include <rapidjson/prettywriter.h>
#include <rapidjson/stringbuffer.h>

#include <charconv>
#include <cmath>
#include <string_view>

namespace hooke {
namespace {

using Writer = rapidjson::PrettyWriter<rapidjson::StringBuffer>;

void write_text(Writer& writer, const char* key, const std::string& text) {
  writer.Key(key);
  writer.String(text.data(), static_cast<rapidjson::SizeType>(text.size()));
}

void write_number(Writer& writer, const char* key, std::optional<double> number) {
  writer.Key(key);
  if (number && std::isfinite(*number))
    writer.Double(*number);
  else
    writer.Null();
}

void write_whole(Writer& writer, const char* key, long number) {
  writer.Key(key);
  writer.Int64(number);
}

const char* name_of(Measure measure) { return measure == Measure::Trajectory ? "trajectory" : "observables"; }

void write_reference(Writer& writer, const std::optional<ReferenceRecord>& reference) {
  writer.Key("reference");
  if (!reference) {
    writer.Null();
    return;
  }
  writer.StartObject();
  write_text(writer, "method", reference->method);
  write_text(writer, "setting", reference->setting);
  write_number(writer, "own_gap", reference->own_gap);
  write_text(writer, "other_method", reference->other_method);
  write_text(writer, "other_setting", reference->other_setting);
  write_number(writer, "other_own_gap", reference->other_own_gap);
  write_number(writer, "other_gap", reference->other_gap);
  write_number(writer, "amplification", reference->amplification);
  write_text(writer, "judged_by", name_of(reference->measure));
  writer.EndObject();
}

void write_row(Writer& writer, const Row& row) {
  writer.StartObject();
  write_text(writer, "method", row.method);
  write_text(writer, "setting", row.setting);
  write_number(writer, "step_s", row.step);
  write_number(writer, "tolerance_m", row.tolerance);
  write_number(writer, "error_m", row.error);
  write_number(writer, "relative_error", row.relative_error);
  write_number(writer, "cpu_ms_per_s", row.cpu_ms_per_s);
  write_whole(writer, "runs", row.runs);
  write_whole(writer, "force_evaluations", row.work.force_evaluations);
  write_whole(writer, "factorizations", row.work.factorizations);
  write_whole(writer, "solves", row.work.solves);
  write_whole(writer, "sweeps", row.work.sweeps);
  write_number(writer, "energy_drift", row.energy_drift);
  write_number(writer, "strain_error", row.strain_error);
  write_text(writer, "status", row.status);
  writer.EndObject();
}

// Reads the output of the functions above; anything else is refused with the name of the field.
class Reader {
 public:
  Reader(const rapidjson::Value& object, const std::string& name) : object_(object), name_(name) {
    if (!object.IsObject()) refuse("an object is missing");
  }

  std::string text(const char* key) const {
    const rapidjson::Value& value = at(key);
    if (!value.IsString()) refuse(std::string(key) + ": not a string");
    return {value.GetString(), value.GetStringLength()};
  }
  std::optional<double> number_or_null(const char* key) const {
    const rapidjson::Value& value = at(key);
    if (value.IsNull()) return std::nullopt;
    if (!value.IsNumber()) refuse(std::string(key) + ": not a number");
    return value.GetDouble();
  }
  double number(const char* key) const { return number_or_null(key).value_or(NAN); }
  long integer(const char* key) const {
    const rapidjson::Value& value = at(key);
    if (!value.IsInt64()) refuse(std::string(key) + ": not a whole number");
    return value.GetInt64();
  }
  const rapidjson::Value& list(const char* key) const {
    const rapidjson::Value& value = at(key);
    if (!value.IsArray()) refuse(std::string(key) + ": not a list");
    return value;
  }
  std::optional<Reader> object(const char* key) const {
    const rapidjson::Value& value = at(key);
    if (value.IsNull()) return std::nullopt;
    return Reader(value, name_);
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

ReferenceRecord read_reference(const Reader& reader) {
  return {.method = reader.text("method"),
          .setting = reader.text("setting"),
          .other_method = reader.text("other_method"),
          .other_setting = reader.text("other_setting"),
          .own_gap = reader.number("own_gap"),
          .other_own_gap = reader.number("other_own_gap"),
          .other_gap = reader.number("other_gap"),
          .amplification = reader.number("amplification"),
          .measure = reader.text("judged_by") == name_of(Measure::Trajectory) ? Measure::Trajectory : Measure::Observables};
}

Row read_row(const Reader& reader) {
  return {.method = reader.text("method"),
          .setting = reader.text("setting"),
          .step = reader.number_or_null("step_s"),
          .tolerance = reader.number_or_null("tolerance_m"),
          .error = reader.number_or_null("error_m"),
          .relative_error = reader.number_or_null("relative_error"),
          .energy_drift = reader.number_or_null("energy_drift"),
          .strain_error = reader.number_or_null("strain_error"),
          .cpu_ms_per_s = reader.number_or_null("cpu_ms_per_s"),
          .runs = static_cast<int>(reader.integer("runs")),
          .work = {.force_evaluations = reader.integer("force_evaluations"),
                   .factorizations = reader.integer("factorizations"),
                   .solves = reader.integer("solves"),
                   .sweeps = reader.integer("sweeps")},
          .status = reader.text("status")};
}

ProblemRecord read_problem(const Reader& reader, const std::string& name) {
  ProblemRecord record{.id = reader.text("scene"),
                       .title = reader.text("title"),
                       .points = static_cast<Index>(reader.integer("points")),
                       .springs = static_cast<Index>(reader.integer("springs")),
                       .seconds = reader.number("seconds"),
                       .size = reader.number("size_m")};
  const std::string print = reader.text("fingerprint");
  std::from_chars(print.data(), print.data() + print.size(), record.fingerprint, 16);
  if (const std::optional<Reader> reference = reader.object("reference")) record.reference = read_reference(*reference);
  for (const rapidjson::Value& row : reader.list("rows").GetArray()) record.rows.push_back(read_row(Reader(row, name)));
  return record;
}

// the shortest digits that read back as the same number
void append(std::string& line, std::optional<double> number) {
  line += ',';
  if (!number || !std::isfinite(*number)) return;
  char text[32];
  line.append(text, std::to_chars(text, text + sizeof text, *number).ptr);
}

// quoted if a name contains a comma or a quote (RFC 4180)
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string format_results(const Results& results) {
  rapidjson::StringBuffer buffer;
  Writer writer(buffer);
  writer.SetIndent(' ', 1);
  writer.StartObject();
  write_whole(writer, "hooke_bench", 1L);
  write_text(writer, "version", results.conditions.version);
  write_text(writer, "build", results.conditions.build);
  write_text(writer, "machine", results.conditions.machine);
  write_text(writer, "effort", results.conditions.effort);
  write_text(writer, "date", results.date);
  writer.Key("scenes");
  writer.StartArray();
  for (const ProblemRecord& record : results.problems) {
    char print[17] = {};
    std::to_chars(print, print + 16, record.fingerprint, 16);
    writer.StartObject();
    write_text(writer, "scene", record.id);
    write_text(writer, "title", record.title);
    write_whole(writer, "points", record.points);
    write_whole(writer, "springs", record.springs);
    write_number(writer, "seconds", record.seconds);
    write_number(writer, "size_m", record.size);
    write_text(writer, "fingerprint", print);
    write_reference(writer, record.reference);
    writer.Key("rows");
    writer.StartArray();
    for (const Row& row : record.rows) write_row(writer, row);
    writer.EndArray();
    writer.EndObject();
  }
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
  const Reader reader(document, name);
  reader.integer("hooke_bench");
  Results results{.conditions = {.version = reader.text("version"),
                                 .build = reader.text("build"),
                                 .machine = reader.text("machine"),
                                 .effort = reader.text("effort")},
                  .date = reader.text("date")};
  for (const rapidjson::Value& problem : reader.list("scenes").GetArray())
    results.problems.push_back(read_problem(Reader(problem, name), name));
  return results;
}

std::string format_csv(const Results& results) {
  std::string text =
      "scene,method,setting,step_s,error_m,relative_error,cpu_ms_per_s,force_evaluations,factorizations,energy_drift,status\n";
  for (const ProblemRecord& record : results.problems)
    for (const Row& row : record.rows) {
      text += field(record.id) + ',' + row.method + ',' + row.setting;
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
