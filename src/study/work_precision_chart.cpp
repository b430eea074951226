#include "study/work_precision_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/formatted.h"

namespace hooke {
namespace {

// Pixels.
constexpr int panel_width = 920, panel_height = 640, header_height = 76;

// Decades of the relative error in the chart.
constexpr int worst_decade = 0, best_decade = -13;

// Okabe and Ito 2008, without their yellow, which prints badly; colors repeat with other dashes.
constexpr std::array colors{"#0072B2", "#D55E00", "#009E73", "#000000", "#CC79A7", "#E69F00", "#56B4E9"};
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

void print_panel(std::string& script, const ProblemRecord& record, std::size_t place) {
  const std::vector<Line> lines = lines_of(record);
  std::vector<const Row*> best;
  for (const Row* row : pareto_front(record))
    if (is_drawn(*row)) best.push_back(row);

  const std::string data = "$panel" + std::to_string(place) + "_";
  for (const Line& line : lines) print_data(script, data + line.data, line.rows);
  print_data(script, data + "front", best);

  script += "set xrange [*:*]\nunset label\nunset arrow\n";
  script += "set label " + gnuplot_text(record.id + ": " + record.title) + " at graph 0,1.065 left noenhanced font ',15'\n";
  script += "set label " + gnuplot_text(subtitle(record)) + " at graph 0,1.025 left noenhanced textcolor rgb '#555555' font ',12'\n";
  if (lines.empty()) {
    script += "set label 'nothing measured' at graph 0.5,0.5 center\nplot [1:10] 1e-30 notitle\n";
    return;
  }
  if (record.reference && record.reference->uncertainty() > std::pow(10.0, best_decade))
    append_formatted(script, "set arrow from graph 0,first %.6g to graph 1,first %.6g nohead back dashtype 3 linecolor rgb '#888888'\n",
                     record.reference->uncertainty(), record.reference->uncertainty());

  script += "plot " + data + "front with lines linewidth 11 linecolor rgb '#DDDDDD' notitle";
  for (const Line& line : lines) {
    script += ", \\\n  " + data + line.data;
    append_formatted(script, " with linespoints linewidth 1.8 dashtype %d pointtype %d pointsize 0.9 linecolor rgb '%s' title ",
                     static_cast<int>(1 + line.style / colors.size()), markers[line.style % markers.size()],
                     colors[line.style % colors.size()]);
    script += gnuplot_text(line.method);
  }
  script += '\n';
}

}  // namespace

GnuplotChart work_precision_chart(const Results& results) {
  const int count = std::max<int>(1, static_cast<int>(results.problems.size()));
  const int columns = count == 1 ? 1 : 2, rows = (count + columns - 1) / columns;
  std::string script =
      "set tmargin 5\n"
      "set logscale xy\n"
      "set format y '10^{%T}'\n"
      "set format x '%g'\n"
      "set grid xtics ytics linecolor rgb '#EEEEEE' linetype 1\n"
      "set ylabel 'relative error' offset 1,0\n"
      "set key rmargin top Left reverse noenhanced samplen 2 font ',13'\n";
  const bool has_device = std::ranges::any_of(results.problems, [](const ProblemRecord& record) {
    return std::ranges::any_of(record.rows, [](const Row& row) { return row.method.ends_with(on_device); });
  });
  append_formatted(script, "set xlabel '%s, ms per simulated second' offset 0,0.3\n",
                   has_device ? "CPU time (on GPU: real time)" : "CPU time");
  append_formatted(script,
                   "set yrange [1e%d:1e%d]\n"
                   "set multiplot layout %d,%d title \"Speed against error\\n{/*0.65 Lower left is better. No measured setting is both "
                   "cheaper and more accurate than the wide gray line.}\" font ',20'\n",
                   best_decade, worst_decade, rows, columns);
  std::size_t place = 0;
  for (const ProblemRecord& record : results.problems) print_panel(script, record, place++);
  return {columns * panel_width, rows * panel_height + header_height, script + "unset multiplot\n"};
}

}  // namespace hooke
