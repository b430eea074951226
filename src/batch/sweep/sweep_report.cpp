#include "batch/sweep/sweep_report.h"

#include <algorithm>
#include <array>

#include "base/csv_field.h"
#include "base/json_writer.h"
#include "scene/parameter_value.h"

namespace hooke {
namespace {

using TableLayout = JsonWriter::Layout;

constexpr std::array<std::string_view, 3> sweep_statuses{"ok", "warning", "diverged"};

std::string in_brackets(std::string_view unit) { return unit.empty() ? "" : " [" + std::string(unit) + "]"; }

void write_value(JsonWriter& json, const Parameter& parameter, double value) {
  if (parameter.is_number())
    json.number(value);
  else
    json.text(value_text(parameter, value));
}

}  // namespace

std::string_view sweep_status_name(SweepRow::Status status) { return sweep_statuses[static_cast<std::size_t>(status)]; }

std::optional<SweepRow::Status> find_sweep_status(std::string_view name) {
  const auto at = std::ranges::find(sweep_statuses, name);
  return at == sweep_statuses.end() ? std::nullopt : std::optional(static_cast<SweepRow::Status>(at - sweep_statuses.begin()));
}

std::string format_sweep_csv(const Sweep& sweep, const SweepRows& rows) {
  std::string text;
  for (const SweepAxis& axis : sweep.axes) text += std::string(axis.parameter->name) + in_brackets(axis.parameter->unit) + ',';
  for (const SweepMeasure& measure : sweep.measures) text += measure.name + in_brackets(measure.unit()) + ',';
  text += "status,note\n";
  for (const auto& [number, row] : rows) {
    const std::vector<double> values = sweep.values_of(number);
    for (std::size_t i = 0; i < values.size(); ++i) text += value_text(*sweep.axes[i].parameter, values[i]) + ',';
    for (const std::optional<double>& value : row.values) text += (value ? format_exact(*value) : std::string()) + ',';
    text += std::string(sweep_status_name(row.status)) + ',' + csv_field(row.note) + '\n';
  }
  return text;
}

std::string format_sweep_json(const Sweep& sweep, const SweepRows& rows) {
  JsonWriter json;
  json.begin_object(TableLayout::Lines);
  json.integer("hooke_sweep", 1);
  json.text("scene", sweep.scene);
  json.number("seconds", sweep.seconds);
  json.boolean("complete", rows.size() == sweep.row_count());
  json.objects("vary", sweep.axes, [&](const SweepAxis& axis) {
    json.text("name", axis.parameter->name);
    json.text("unit", axis.parameter->unit);
    json.list("values", TableLayout::Line, axis.values, [&](double value) { write_value(json, *axis.parameter, value); });
  });
  json.objects("measures", sweep.measures, [&](const SweepMeasure& measure) {
    json.text("name", measure.name);
    json.text("unit", measure.unit());
  });
  json.integer("row_count", static_cast<std::int64_t>(sweep.row_count()));
  json.objects("rows", rows, [&](const auto& numbered) {
    const auto& [number, row] = numbered;
    json.integer("row", static_cast<std::int64_t>(number));
    const std::vector<double> values = sweep.values_of(number);
    for (std::size_t i = 0; i < values.size(); ++i) {
      json.key(sweep.axes[i].parameter->name);
      write_value(json, *sweep.axes[i].parameter, values[i]);
    }
    // a quantity may have the name of a parameter
    json.list("values", TableLayout::Line, row.values, [&](const std::optional<double>& value) { json.number(value); });
    json.text("status", sweep_status_name(row.status));
    json.text("note", row.note);
  });
  json.end();
  return json.take() + "\n";
}

}  // namespace hooke
