#include "batch/sweep/sweep_journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <functional>
#include <limits>

#include "base/build_info.h"
#include "base/errors.h"
#include "base/formatted.h"
#include "base/json_field.h"
#include "base/json_writer.h"
#include "base/printable.h"
#include "base/read_file.h"
#include "batch/sweep/sweep_report.h"
#include "scene/parameter_value.h"

namespace hooke {
namespace {

std::string format_row(const SweepRow& row) {
  JsonWriter json;
  json.begin_object(JsonWriter::Layout::Line);
  json.integer("row", static_cast<std::int64_t>(row.row));
  json.text("status", sweep_status_name(row.status));
  json.text("note", row.note);
  json.list("values", JsonWriter::Layout::Line, row.values, [&](const std::optional<double>& value) { json.number(value); });
  json.end();
  return json.take() + "\n";
}

// Calls `read` for each member of a line and checks that there are `count` different known ones; `read` returns whether it knows the
// member.
void read_line(const std::string& line, const std::string& location, int count, const std::function<bool(const JsonField& field)>& read) {
  int known = 0;
  const auto count_member = [&](const JsonField& field) { known += read(field) ? 1 : 0; };
  read_members(line, location, count_member, true);
  if (known != count) throw InputError(location + ": members are missing: not a sweep");
}

SweepAxis read_axis(const JsonField& item) {
  SweepAxis axis;
  for (const JsonField field : item.members()) {
    if (field.is("name") && (axis.parameter = find_parameter(field.text())) == nullptr) field.refuse("no such parameter");
    if (!field.is("values")) continue;
    if (axis.parameter == nullptr) field.refuse("must come after the name");
    for (const JsonField value : field.items(1, max_sweep_rows)) {
      const auto known = parse_value(*axis.parameter, value.text());
      if (!known) value.refuse(limit_text(*axis.parameter));
      axis.values.push_back(*known);
    }
  }
  if (axis.values.empty()) item.refuse_missing("values", "must be a list [...]");
  return axis;
}

bool read_definition(const JsonField& field, Sweep& sweep) {
  constexpr std::size_t max_items = 1000;
  if (field.is("hooke_sweep")) {
    if (field.number() != 1.0) field.refuse("must be 1");
  } else if (field.is("version")) {
    field.text();
  } else if (field.is("scene")) {
    sweep.scene = field.text();
  } else if (field.is("fingerprint")) {
    std::from_chars(field.text().data(), field.text().data() + field.text().size(), sweep.fingerprint, 16);
  } else if (field.is("seconds")) {
    sweep.seconds = field.number(not_negative);
  } else if (field.is("vary")) {
    for (const JsonField item : field.items(1, max_items)) sweep.axes.push_back(read_axis(item));
    if (sweep.row_count() > max_sweep_rows) field.refuse("must be at most " + std::to_string(max_sweep_rows) + " combinations");
  } else if (field.is("measures")) {
    for (const JsonField item : field.items(1, max_items)) {
      constexpr Index any = std::numeric_limits<Index>::max();
      const std::string reason = parse_measures(item.text(), any, any, sweep.measures);
      if (!reason.empty()) item.refuse(reason);
    }
  } else {
    return false;
  }
  return true;
}

bool read_row(const JsonField& field, const Sweep& sweep, SweepRow& row) {
  if (field.is("row")) {
    row.row = static_cast<std::size_t>(field.integer(0, static_cast<std::int64_t>(sweep.row_count()) - 1));
  } else if (field.is("status")) {
    const std::optional<SweepRow::Status> status = find_sweep_status(field.text());
    if (!status) field.refuse("must be ok, warning or diverged");
    row.status = *status;
  } else if (field.is("note")) {
    row.note = field.text();
  } else if (field.is("values")) {
    for (const JsonField value : field.items(sweep.measures.size(), sweep.measures.size()))
      row.values.push_back(value.is_null() ? std::nullopt : std::optional(value.number()));
  } else {
    return false;
  }
  return true;
}

}  // namespace

std::string format_definition(const Sweep& sweep) {
  JsonWriter json;
  json.begin_object(JsonWriter::Layout::Line);
  json.integer("hooke_sweep", 1);
  json.text("version", program_version);
  json.text("scene", sweep.scene);
  json.text("fingerprint", formatted("%016llx", static_cast<unsigned long long>(sweep.fingerprint)));
  json.number("seconds", sweep.seconds);
  json.list("vary", JsonWriter::Layout::Line, sweep.axes, [&](const SweepAxis& axis) {
    json.begin_object(JsonWriter::Layout::Line);
    json.text("name", axis.parameter->name);
    json.list("values", JsonWriter::Layout::Line, axis.values, [&](double value) { json.text(value_text(*axis.parameter, value)); });
    json.end();
  });
  json.list("measures", JsonWriter::Layout::Line, sweep.measures, [&](const SweepMeasure& measure) { json.text(measure.name); });
  json.end();
  return json.take() + "\n";
}

JournalContents parse_journal(const std::string& text, const std::string& name) {
  JournalContents contents;
  std::size_t begin = 0;
  for (int number = 1;; ++number) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;
    const std::string line = text.substr(begin, end - begin);
    const std::string location = name + ": line " + std::to_string(number);
    if (number == 1) {
      read_line(line, location, 7, [&](const JsonField& field) { return read_definition(field, contents.sweep); });
      contents.definition = line + "\n";
    } else {
      SweepRow row;
      read_line(line, location, 4, [&](const JsonField& field) { return read_row(field, contents.sweep, row); });
      contents.rows.emplace(row.row, row);
    }
    begin = end + 1;
  }
  contents.complete_bytes = begin;
  return contents;
}

std::string format_journal(const Sweep& sweep, const SweepRows& rows) {
  std::string text = format_definition(sweep);
  for (const auto& [number, row] : rows) text += format_row(row);
  return text;
}

SweepJournal::SweepJournal(const std::filesystem::path& file, const Sweep& sweep) : file_(file) {
  const std::string name = printable(file.native());
  descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw FileError(name + ": cannot be opened: " + std::strerror(errno));
  // the destructor does not run if this throws
  try {
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) throw FileError(name + ": is in use by another sweep");
    const std::string text = read_file(file);
    const JournalContents contents = parse_journal(text, name);
    if (contents.complete_bytes > 0 && contents.definition != format_definition(sweep))
      throw InputError(name + ": contains another sweep: scene, options or version differ; use another --out");
    if (contents.complete_bytes < text.size() && ftruncate(descriptor_, static_cast<off_t>(contents.complete_bytes)) != 0)
      throw FileError(name + ": cannot be written: " + std::strerror(errno));
    rows_ = contents.rows;
    if (contents.complete_bytes == 0) write(format_definition(sweep));
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

SweepJournal::~SweepJournal() { close(descriptor_); }

void SweepJournal::add(const SweepRow& row) {
  write(format_row(row));
  rows_.emplace(row.row, row);
}

// in one call, so that a process that is killed leaves complete lines
void SweepJournal::write(const std::string& text) {
  errno = 0;
  if (::write(descriptor_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    throw FileError(printable(file_.native()) + ": cannot be written: " + std::strerror(errno != 0 ? errno : ENOSPC));
}

JournalContents merge_journals(const std::vector<std::filesystem::path>& files) {
  JournalContents merged;
  std::string first;
  for (const std::filesystem::path& file : files) {
    const std::string name = printable(file.native());
    JournalContents contents = parse_journal(read_file(file), name);
    if (contents.complete_bytes == 0) throw InputError(name + ": is empty: not a sweep");
    if (first.empty()) {
      first = name;
      merged = std::move(contents);
      continue;
    }
    if (contents.definition != merged.definition)
      throw InputError(name + ": contains another sweep than " + first + ": scene, options or version differ");
    merged.rows.merge(contents.rows);
  }
  return merged;
}

}  // namespace hooke
