#include "study/work_precision_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "base/formatted.h"
#include "study/gnuplot_text.h"
#include "study/label_placement.h"

namespace hooke {
namespace {

// Pixels.
constexpr int panel_width = 920, panel_height = 640, header_height = 76;
constexpr int left_margin = 84, right_margin = 24, top_margin = 58, bottom_margin = 62;
constexpr double label_height = 17.0, letter_width = 7.9;

// Decades of the relative error in the chart.
constexpr int worst_decade = 0, best_decade = -13;

// Okabe and Ito 2008, without their yellow, which prints badly; colors repeat with dashed lines.
constexpr std::array colors{"#0072B2", "#D55E00", "#009E73", "#000000", "#CC79A7", "#E69F00", "#56B4E9"};
// the same colors, darker, for text
constexpr std::array text_colors{"#005A8E", "#A84A00", "#007A59", "#000000", "#9C4A77", "#9A6A00", "#2A7CAE"};
constexpr std::array markers{7, 5, 9, 13, 11, 15, 6, 4, 8, 12, 10, 14, 2, 1};

struct Line {
  std::string method;
  std::string data;  // its name in the script
  std::size_t style = 0;
  std::vector<const Row*> rows;
};

bool is_drawn(const Row& row) {
  return row.relative_error && *row.relative_error < std::pow(10.0, worst_decade) && *row.relative_error > std::pow(10.0, best_decade) &&
         *row.cpu_ms_per_s > 0.0;
}

std::vector<Line> lines_of(const ProblemRecord& record) {
  std::vector<Line> lines;
  std::size_t style = 0;
  for (const Integrator& method : integrators()) {
    Line line{.method = std::string(method.id), .data = std::string(method.id), .style = style++};
    for (const Row& row : record.rows)
      if (row.method == method.id && is_drawn(row)) line.rows.push_back(&row);
    if (!line.rows.empty()) lines.push_back(std::move(line));
  }
  // other engines, in the order of their rows; their names are untrusted text
  for (const Row& row : record.rows) {
    if (!is_drawn(row) || find_integrator(row.method) != nullptr) continue;
    auto line = std::ranges::find(lines, row.method, &Line::method);
    if (line == lines.end())
      line = lines.insert(lines.end(), {.method = row.method, .data = "engine" + std::to_string(style), .style = style});
    if (line->rows.empty()) ++style;
    line->rows.push_back(&row);
  }
  return lines;
}

// Above all panels; printed with the first panel, since labels belong to a panel.
void print_header(std::string& script, int columns, int rows) {
  const double left = static_cast<double>(left_margin) / (columns * panel_width), height = rows * panel_height + header_height;
  append_formatted(script, "set label 'Speed against error' at screen %.6f,%.6f left font ',20'\n", left, 1.0 - 26.0 / height);
  append_formatted(
      script,
      "set label 'Lower left is better. The wide gray line is the Pareto front: no measured setting is both cheaper and more accurate.' "
      "at screen %.6f,%.6f left textcolor rgb '#333333' font ',13'\n",
      left, 1.0 - 54.0 / height);
}

// [px], the plotting area of a panel, relative to its lower left corner.
struct Axes {
  double min_cost = 1.0, max_cost = 10.0;  // [ms per s]
  double x_of(double cost) const {
    return (panel_width - left_margin - right_margin) * std::log(cost / min_cost) / std::log(max_cost / min_cost);
  }
  double y_of(double error) const {
    return (panel_height - top_margin - bottom_margin) * (std::log10(error) - best_decade) / (worst_decade - best_decade);
  }
  ChartPoint at(const Row& row) const { return {x_of(*row.cpu_ms_per_s), y_of(*row.relative_error)}; }
};

Axes axes_of(const std::vector<Line>& lines) {
  double min = INFINITY, max = 0.0;
  for (const Line& line : lines)
    for (const Row* row : line.rows) {
      min = std::min(min, *row->cpu_ms_per_s);
      max = std::max(max, *row->cpu_ms_per_s);
    }
  if (lines.empty()) return {};
  // a margin on the right for the names of the lines; at least two labeled ticks
  constexpr double before = 0.7, behind = 5.0;
  if (max < 4.0 * min) return {.min_cost = std::pow(10.0, std::floor(std::log10(min))), .max_cost = behind * max};
  return {.min_cost = before * min, .max_cost = behind * max};
}

// points along the lines, so close together that no label fits between two
std::vector<ChartPoint> sample_lines(const std::vector<Line>& lines, const Axes& axes) {
  std::vector<ChartPoint> line_points;
  for (const Line& line : lines)
    for (std::size_t i = 0; i < line.rows.size(); ++i) {
      const ChartPoint to = axes.at(*line.rows[i]), from = i > 0 ? axes.at(*line.rows[i - 1]) : to;
      const int pieces = 1 + static_cast<int>(std::hypot(to.x - from.x, to.y - from.y) / 6.0);
      for (int piece = 1; piece <= pieces; ++piece) {
        const double part = static_cast<double>(piece) / pieces;
        line_points.push_back({from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)});
      }
    }
  return line_points;
}

void print_labels(std::string& script, const std::vector<Line>& lines, const Axes& axes) {
  std::vector<ChartLabel> labels;
  for (const Line& line : lines)
    labels.push_back({axes.at(*line.rows.back()), letter_width * static_cast<double>(line.method.size()), label_height});
  const ChartBox frame{2.0, 2.0, panel_width - left_margin - right_margin - 2.0, panel_height - top_margin - bottom_margin - 2.0};
  const std::vector<PlacedLabel> places = place_labels(labels, sample_lines(lines, axes), frame);
  const double width = panel_width - left_margin - right_margin, height = panel_height - top_margin - bottom_margin;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const ChartPoint &at = places[i].at, &end = labels[i].anchor;
    const char* color = text_colors[lines[i].style % text_colors.size()];
    script += "set label " + gnuplot_text(lines[i].method);
    append_formatted(script, " at graph %.4f,%.4f %s front noenhanced textcolor rgb '%s' font ',13'\n", at.x / width, at.y / height,
                     places[i].justify == Justify::Left ? "left" : "right", color);
    // an arrow connects a name that is not at the end of its line with that end
    if (std::hypot(at.x - end.x, at.y - end.y) > 20.0)
      append_formatted(script, "set arrow from graph %.4f,%.4f to graph %.4f,%.4f nohead back linewidth 0.8 linecolor rgb '%s'\n",
                       end.x / width, end.y / height, at.x / width, at.y / height, color);
  }
}

std::string subtitle(const ProblemRecord& record) {
  if (!record.reference) return "no reference";
  const ReferenceRecord& reference = *record.reference;
  return formatted(
      "%s; reference accurate to %.0e; a perturbation grows by a factor of %.2g in %g s",
      reference.measure == Measure::Trajectory ? "error of the positions" : "error of center of mass, largest strain and energy",
      reference.uncertainty(), reference.amplification, record.seconds);
}

void print_data(std::string& script, const std::string& name, const std::vector<const Row*>& rows) {
  script += name + " << EOD\n";
  for (const Row* row : rows) append_formatted(script, "%.6g %.6g\n", *row->cpu_ms_per_s, *row->relative_error);
  script += "EOD\n";
}

void print_panel(std::string& script, const ProblemRecord& record, std::size_t place, int columns, int rows) {
  const std::vector<Line> lines = lines_of(record);
  const Axes axes = axes_of(lines);
  std::vector<const Row*> best;
  for (const Row* row : pareto_front(record))
    if (is_drawn(*row)) best.push_back(row);

  const std::string data = "$panel" + std::to_string(place) + "_";
  for (const Line& line : lines) print_data(script, data + line.data, line.rows);
  print_data(script, data + "front", best);

  const double width = columns * panel_width, height = rows * panel_height + header_height;
  const auto column = place % columns, row = place / columns;
  const double left = static_cast<double>(column) * panel_width;
  const double top = height - header_height - static_cast<double>(row) * panel_height;
  append_formatted(script, "set lmargin at screen %.6f\nset rmargin at screen %.6f\n", (left + left_margin) / width,
                   (left + panel_width - right_margin) / width);
  append_formatted(script, "set tmargin at screen %.6f\nset bmargin at screen %.6f\n", (top - top_margin) / height,
                   (top - panel_height + bottom_margin) / height);
  append_formatted(script, "set xrange [%.6g:%.6g]\nset yrange [1e%d:1e%d]\nunset label\nunset arrow\n", axes.min_cost, axes.max_cost,
                   best_decade, worst_decade);
  if (place == 0) print_header(script, columns, rows);
  script += "set label " + gnuplot_text(record.id + ": " + record.title) + " at graph 0,1.065 left noenhanced font ',15'\n";
  script += "set label " + gnuplot_text(subtitle(record)) + " at graph 0,1.025 left noenhanced textcolor rgb '#555555' font ',12'\n";
  if (lines.empty()) {
    script += "set label 'nothing measured' at graph 0.5,0.5 center\nplot 1e-30 notitle\n";
    return;
  }
  if (record.reference && record.reference->uncertainty() > std::pow(10.0, best_decade))
    append_formatted(script, "set arrow from graph 0,first %.6g to graph 1,first %.6g nohead back dashtype 3 linecolor rgb '#888888'\n",
                     record.reference->uncertainty(), record.reference->uncertainty());
  print_labels(script, lines, axes);

  script += "plot " + data + "front with lines linewidth 11 linecolor rgb '#DDDDDD' notitle";
  for (const Line& line : lines) {
    script += ", \\\n  " + data + line.data;
    append_formatted(script, " with linespoints linewidth 1.8 dashtype %d pointtype %d pointsize 0.9 linecolor rgb '%s' notitle",
                     line.style < colors.size() ? 1 : 2, markers[line.style % markers.size()], colors[line.style % colors.size()]);
  }
  script += '\n';
}

}  // namespace

std::string chart_script(const Results& results, ChartFormat format) {
  const int count = std::max<int>(1, static_cast<int>(results.problems.size()));
  const int columns = count == 1 ? 1 : 2, rows = (count + columns - 1) / columns;
  std::string script;
  append_formatted(script, "set terminal %s size %d,%d font 'DejaVu Sans,12' background '#ffffff'\n",
                   format == ChartFormat::Svg ? "svg" : "pngcairo", columns * panel_width, rows * panel_height + header_height);
  script +=
      "set encoding utf8\n"
      "set multiplot\n"
      "set logscale xy\n"
      "set format y '10^{%T}'\n"
      "set format x '%g'\n"
      "set grid xtics ytics linecolor rgb '#EEEEEE' linetype 1\n"
      "set border 3 linecolor rgb '#888888'\n"
      "set tics nomirror out textcolor rgb '#333333'\n"
      "set xlabel 'CPU time, ms per simulated second' offset 0,0.3\n"
      "set ylabel 'relative error' offset 1,0\n"
      "unset key\n";
  std::size_t place = 0;
  for (const ProblemRecord& record : results.problems) print_panel(script, record, place++, columns, rows);
  script += "unset multiplot\n";
  return script;
}

}  // namespace hooke
