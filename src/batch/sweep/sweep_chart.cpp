#include "batch/sweep/sweep_chart.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/formatted.h"
#include "scene/parameter_value.h"

namespace hooke {
namespace {

constexpr int panel_width = 760, panel_height = 520;  // [px]
constexpr std::size_t max_lines = 8;

// Okabe and Ito 2008, without their yellow, which prints badly.
constexpr std::array colors{"#0072B2", "#D55E00", "#009E73", "#000000", "#CC79A7", "#E69F00", "#56B4E9", "#888888"};

std::string heading(std::string_view name, std::string_view unit) {
  return std::string(name) + (unit.empty() || unit == "1" ? "" : " [" + std::string(unit) + "]");
}

std::string heading(const SweepAxis& axis) { return heading(axis.parameter->name, axis.parameter->unit); }

// Which axis is horizontal: that with the most values; numbers before choices.
std::size_t horizontal_axis(const Sweep& sweep) {
  std::size_t best = 0;
  const auto rank = [&](std::size_t i) { return std::pair(sweep.axes[i].parameter->is_number(), sweep.axes[i].values.size()); };
  for (std::size_t i = 1; i < sweep.axes.size(); ++i)
    if (rank(i) > rank(best)) best = i;
  return best;
}

// A logarithmic scale where values are positive and span more than a factor of 20.
bool is_logarithmic(double min, double max) { return min > 0.0 && max > 20.0 * min; }

bool is_logarithmic(const SweepAxis& axis) {
  const auto [min, max] = std::ranges::minmax(axis.values);
  return axis.parameter->is_number() && is_logarithmic(min, max);
}

// The position of a value on its axis: the number itself, or the index of a choice.
double position(const SweepAxis& axis, double value) {
  if (axis.parameter->is_number()) return value;
  return static_cast<double>(std::ranges::find(axis.values, value) - axis.values.begin());
}

void set_scale(std::string& script, const char* letter, const SweepAxis& axis) {
  script += formatted("set %slabel ", letter) + gnuplot_text(heading(axis)) + " noenhanced\n";
  script += formatted("%s logscale %s\nset %stics autofreq\n", is_logarithmic(axis) ? "set" : "unset", letter, letter);
  if (axis.parameter->is_number()) return;
  script += formatted("set %stics (", letter);
  for (std::size_t i = 0; i < axis.values.size(); ++i)
    script += (i > 0 ? ", " : "") + gnuplot_text(value_text(*axis.parameter, axis.values[i])) + " " + std::to_string(i);
  script += ")\n";
}

struct Range {
  double min = HUGE_VAL, max = -HUGE_VAL;
  bool is_empty() const { return min > max; }
};

Range range_of(const SweepRows& rows, std::size_t measure) {
  Range range;
  for (const auto& [number, row] : rows)
    if (const std::optional<double> value = row.values[measure]) {
      range.min = std::min(range.min, *value);
      range.max = std::max(range.max, *value);
    }
  return range;
}

// The range of an axis or of the colors. Where all values are equal, or print equal, gnuplot would choose the same but warn.
std::string range_setting(const char* letters, const Range& range) {
  const double magnitude = std::max(std::abs(range.min), std::abs(range.max));
  if (range.max - range.min > 1e-8 * magnitude) return formatted("set %srange [*:*]\n", letters);
  const double margin = magnitude > 0.0 ? 0.01 * magnitude : 1.0;
  return formatted("set %srange [%.9g:%.9g]\n", letters, range.min - margin, range.max + margin);
}

Range range_of(const SweepAxis& axis) {
  Range range;
  for (const double value : axis.values) {
    range.min = std::min(range.min, position(axis, value));
    range.max = std::max(range.max, position(axis, value));
  }
  return range;
}

// The combination of the values of all axes except `without`: "substeps 8, damping 0".
std::string combination(const Sweep& sweep, const std::vector<double>& values, std::size_t without) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i != without)
      text +=
          (text.empty() ? "" : ", ") + std::string(sweep.axes[i].parameter->name) + " " + value_text(*sweep.axes[i].parameter, values[i]);
  return text;
}

void print_lines(std::string& script, const Sweep& sweep, const SweepRows& rows, std::size_t measure, const std::string& data) {
  const std::size_t x = horizontal_axis(sweep);
  std::vector<std::string> names, blocks;
  for (std::size_t row = 0; row < sweep.row_count(); ++row) {
    const std::vector<double> values = sweep.values_of(row);
    const std::string name = combination(sweep, values, x);
    auto at = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    if (at == names.size()) {
      names.push_back(name);
      blocks.emplace_back();
    }
    const auto found = rows.find(row);
    const std::optional<double> value = found == rows.end() ? std::nullopt : found->second.values[measure];
    // an empty line interrupts the line of the chart: a run diverged
    blocks[at] += value ? formatted("%.9g %.9g\n", position(sweep.axes[x], values[x]), *value) : "\n";
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) script += formatted("%s_%zu << EOD\n", data.c_str(), i) + blocks[i] + "EOD\n";
  const Range range = range_of(rows, measure);
  script += is_logarithmic(range.min, range.max) ? "set logscale y\nset format y '%g'\n" : "unset logscale y\nset format y '%g'\n";
  script += range_setting("x", range_of(sweep.axes[x])) + range_setting("y", range);
  set_scale(script, "x", sweep.axes[x]);
  script += "set ylabel " + gnuplot_text(heading(sweep.measures[measure].name, sweep.measures[measure].unit())) + " noenhanced\n";
  script += "plot ";
  for (std::size_t i = 0; i < names.size(); ++i)
    script += (i > 0 ? ", " : "") + formatted("%s_%zu", data.c_str(), i) +
              formatted(" with linespoints linewidth 1.8 pointtype 7 pointsize 0.7 linecolor rgb '%s' ", colors[i % colors.size()]) +
              (names[i].empty() ? "notitle" : "title " + gnuplot_text(names[i]) + " noenhanced");
  script += '\n';
}

// Boundaries of the cell of each value: halfway to its neighbors, on the scale of the axis.
std::vector<double> cell_bounds(const SweepAxis& axis) {
  std::vector<double> at;
  for (const double value : axis.values) at.push_back(position(axis, value));
  std::ranges::sort(at);
  const bool is_log = is_logarithmic(axis);
  if (is_log)
    for (double& value : at) value = std::log(value);
  std::vector<double> bounds{at.size() > 1 ? 1.5 * at[0] - 0.5 * at[1] : at[0] - 0.5};
  for (std::size_t i = 1; i < at.size(); ++i) bounds.push_back(0.5 * (at[i - 1] + at[i]));
  bounds.push_back(2.0 * at.back() - bounds.back());
  if (is_log)
    for (double& value : bounds) value = std::exp(value);
  return bounds;
}

// A cell for each row; those of runs without a value stay gray.
void print_heat_map(std::string& script, const Sweep& sweep, const SweepRows& rows, std::size_t measure, const std::string& data) {
  const std::size_t x = horizontal_axis(sweep), y = 1 - x;
  const std::vector<double> columns = cell_bounds(sweep.axes[x]), lines = cell_bounds(sweep.axes[y]);
  const auto cell = [](const SweepAxis& axis, double value) {
    return static_cast<std::size_t>(
        std::ranges::count_if(axis.values, [&](double other) { return position(axis, other) < position(axis, value); }));
  };
  script += data + " << EOD\n";
  for (const auto& [number, row] : rows) {
    if (!row.values[measure]) continue;
    const std::vector<double> values = sweep.values_of(number);
    const std::size_t i = cell(sweep.axes[x], values[x]), j = cell(sweep.axes[y], values[y]);
    append_formatted(script, "%.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", columns[i], lines[j], columns[i], columns[i + 1], lines[j],
                     lines[j + 1], *row.values[measure]);
  }
  script += "EOD\n";
  const Range range = range_of(rows, measure);
  script += is_logarithmic(range.min, range.max) ? "set logscale cb\nset format cb '%g'\n" : "unset logscale cb\nset format cb '%g'\n";
  script += range_setting("cb", range);
  set_scale(script, "x", sweep.axes[x]);
  set_scale(script, "y", sweep.axes[y]);
  script +=
      "set format y '%g'\nset object 1 rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb '#DDDDDD' fillstyle solid noborder\n";
  append_formatted(script,
                   "plot [%.9g:%.9g] [%.9g:%.9g] %s using 1:2:3:4:5:6:7 with boxxyerror fillstyle solid linecolor palette notitle\n",
                   columns.front(), columns.back(), lines.front(), lines.back(), data.c_str());
}

}  // namespace

std::optional<GnuplotChart> sweep_chart(const Sweep& sweep, const SweepRows& rows) {
  const std::size_t combinations = sweep.row_count() / sweep.axes[horizontal_axis(sweep)].values.size();
  const bool has_lines = combinations <= max_lines;
  if (!has_lines && sweep.axes.size() != 2) return std::nullopt;

  const int count = static_cast<int>(sweep.measures.size()), columns = count == 1 ? 1 : 2, lines = (count + columns - 1) / columns;
  std::string script = formatted("set multiplot layout %d,%d\n", lines, columns);
  script +=
      "set format x '%g'\n"
      "set key outside right top Left reverse samplen 2\n"
      "set palette defined (0 '#440154', 0.25 '#3B528B', 0.5 '#21918C', 0.75 '#5EC962', 1 '#FDE725')\n";
  if (has_lines) script += "set grid xtics ytics linecolor rgb '#EEEEEE' linetype 1\n";
  for (std::size_t i = 0; i < sweep.measures.size(); ++i) {
    const SweepMeasure& measure = sweep.measures[i];
    const auto has_no_value = [&](const auto& row) { return !row.second.values[i]; };
    const bool has_gray_cells = !has_lines && std::ranges::any_of(rows, has_no_value);
    const std::string title = heading(measure.name, measure.unit()) + ": " + sweep.scene + formatted(", %g s", sweep.seconds) +
                              (has_gray_cells ? " (gray: diverged or not known)" : "");
    script += "set title " + gnuplot_text(title) + " noenhanced font ',14'\n";
    const std::string data = "$measure" + std::to_string(i);
    if (range_of(rows, i).is_empty())
      script += "unset logscale\nset label 1 'not known in any run' at graph 0.5,0.5 center\nplot [0:1] [0:1] -1 notitle\nunset label 1\n";
    else if (has_lines)
      print_lines(script, sweep, rows, i, data);
    else
      print_heat_map(script, sweep, rows, i, data);
  }
  return GnuplotChart{columns * panel_width, lines * panel_height, script + "unset multiplot\n"};
}

}  // namespace hooke
