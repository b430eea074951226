// The result of a check in words, as a table and as JSON.
#include <algorithm>
#include <cmath>

#include "base/json_writer.h"
#include "base/number_text.h"
#include "study/check/result_check.h"

namespace hooke {
namespace {

// [1], of the change between two values; none if either is unknown
std::optional<double> change(const CheckedQuantity& quantity, const std::optional<double>& from, const std::optional<double>& to) {
  if (!from || !to) return std::nullopt;
  const double scale = std::max({std::abs(*from), std::abs(*to), quantity.scale});
  return scale > 0.0 ? std::abs(*to - *from) / scale : 0.0;
}

using Value = std::optional<double> CheckedQuantity::*;

// The quantity that changes most between two versions; null if none is known in both.
const CheckedQuantity* largest_change(const ResultCheck& check, Value from, Value to) {
  const CheckedQuantity* most = nullptr;
  double largest = -1.0;
  for (const CheckedQuantity& quantity : check.quantities)
    if (const auto changed = change(quantity, quantity.*from, quantity.*to); changed && *changed > largest)
      largest = *changed, most = &quantity;
  return most;
}

// "64 mm" also where meters would be short: lengths are compared with each other.
std::string length_in_mm(double length) {
  const double size = std::abs(length);
  return size >= 1e-5 && size < 1.0 ? number_text(1000.0 * length, 3) + " mm" : quantity_text(length, "m", 3);
}

std::string from_to(const CheckedQuantity& quantity, Value from, Value to) {
  return std::string(quantity.name) + " " + value_text(quantity, *(quantity.*from)) + " \u2192 " + value_text(quantity, *(quantity.*to));
}

}  // namespace

bool depends(const CheckedQuantity& quantity, const std::optional<double>& from, const std::optional<double>& to) {
  return change(quantity, from, to).value_or(0.0) > independent_change;
}

std::string value_text(const CheckedQuantity& quantity, double value) {
  if (quantity.unit == "m") return length_in_mm(value);
  if (quantity.unit == "1") return number_text(100.0 * value, 3) + " %";
  // an energy counts by its part of what was supplied
  const bool has_part = quantity.unit == "J" && quantity.scale > 0.0;
  return quantity_text(value, quantity.unit, 3) + (has_part ? " (" + number_text(100.0 * value / quantity.scale, 2) + " %)" : "");
}

std::string ResultCheck::sentence() const {
  if (!note.empty()) return note;
  const CheckedQuantity* by_step = largest_change(*this, &CheckedQuantity::now, &CheckedQuantity::half_step);
  const CheckedQuantity* by_points = largest_change(*this, &CheckedQuantity::half_step, &CheckedQuantity::finer);
  std::string text;
  if (by_step == nullptr) {
    text = "The run with half the step diverges";
  } else if (depends(*by_step, by_step->now, by_step->half_step)) {
    text = "Depends on the step: " + from_to(*by_step, &CheckedQuantity::now, &CheckedQuantity::half_step) + ", use a shorter one";
  } else {
    text = "Independent of the step";
    if (distance && *distance <= independent_change * size)
      text += " (" + length_in_mm(*distance) + ")";
    else if (distance)
      text += " except for the positions of the points (RMS " + length_in_mm(*distance) + " after " + quantity_text(seconds, "s", 3) + ")";
  }
  if (by_points == nullptr)
    return text + "; " + (why_not_finer.empty() ? "the run with twice the resolution diverges" : why_not_finer) + ".";
  const std::string shown = from_to(*by_points, &CheckedQuantity::half_step, &CheckedQuantity::finer);
  if (!depends(*by_points, by_points->half_step, by_points->finer)) return text + "; independent of resolution (" + shown + ").";
  return text + "; depends on resolution: " + shown + ", refine once more.";
}

std::string format_table(const ResultCheck& check) {
  std::string text = check.sentence() + "\n";
  if (check.quantities.empty()) return text;
  const auto row = [&](const std::string& name, const std::string& now, const std::string& half, const std::string& finer) {
    const auto padded = [](std::string cell, std::size_t width) {
      cell.resize(std::max(cell.size(), width), ' ');
      return cell;
    };
    std::string line = padded(name, 18) + padded(now, 24) + padded(half, 24) + finer;
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  };
  row("", "now", "half the step", check.why_not_finer.empty() ? "twice the resolution" : "");
  for (const CheckedQuantity& quantity : check.quantities) {
    const auto cell = [&](const std::optional<double>& value) { return value ? value_text(quantity, *value) : std::string("-"); };
    std::string finer = check.why_not_finer.empty() ? cell(quantity.finer) : "";
    const bool is_known = quantity.now && quantity.half_step && (quantity.finer || !check.why_not_finer.empty());
    if (!is_known && !quantity.why_unknown.empty()) finer += (finer.empty() ? "(" : "  (") + quantity.why_unknown + ")";
    row(std::string(quantity.name), cell(quantity.now), cell(quantity.half_step), finer);
  }
  return text;
}

std::string format_json(const ResultCheck& check) {
  JsonWriter out;
  using enum JsonWriter::Layout;
  out.begin_object(Lines);
  out.text("result", check.sentence());
  out.number("seconds", check.seconds);
  out.number("distance", check.distance);
  out.number("size", check.size);
  out.integer("refined_sheets", check.sheets);
  out.integer("refined_ropes", check.ropes);
  out.objects("quantities", check.quantities, [&](const CheckedQuantity& quantity) {
    out.text("name", quantity.name);
    out.text("unit", quantity.unit);
    out.number("now", quantity.now);
    out.number("half_step", quantity.half_step);
    out.number("twice_the_resolution", quantity.finer);
  });
  out.end();
  return out.written() + "\n";
}

}  // namespace hooke
