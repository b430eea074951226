#include "study/plot_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/formatted.h"
#include "base/number_text.h"

namespace hooke {
namespace {

// Okabe and Ito 2008, in the order of the window; repeated with dashes.
constexpr std::array trace_colors{"#0072B2", "#E69F00", "#009E73", "#CC79A7", "#D55E00", "#808080"};
constexpr int chart_width = 920, unit_height = 320;  // [px]

}  // namespace

GnuplotChart plot_chart(const TraceTable& table, double first, double last, bool is_spectrum) {
  std::vector<std::string_view> units;
  for (const Trace& trace : table.traces)
    if (std::ranges::find(units, trace.quantity.row->unit) == units.end()) units.push_back(trace.quantity.row->unit);
  const int panels = std::max(1, static_cast<int>(units.size()));
  std::string script = "set grid xtics ytics linecolor rgb '#EEEEEE' linetype 1\nset key outside top left horizontal noenhanced\n";
  append_formatted(script, "set xrange [%.17g:%.17g]\nset xlabel '%s' noenhanced\n", first, last,
                   is_spectrum ? "frequency [Hz]" : "time [s]");
  for (std::size_t t = 0; t < table.traces.size(); ++t) {
    append_formatted(script, "$trace%zu << EOD\n", t);
    for (std::size_t i = 0; i < table.times.size(); ++i) {
      if (table.times[i] < first || table.times[i] > last) continue;
      if (table.continues[i] == 0) script += '\n';
      if (std::isfinite(table.traces[t].values[i])) append_formatted(script, "%.9g %.9g\n", table.times[i], table.traces[t].values[i]);
    }
    script += "EOD\n";
  }
  append_formatted(script, "set multiplot layout %d,1\n", panels);
  for (const std::string_view unit : units) {
    script += "set ylabel " + gnuplot_text("[" + unit_text(unit) + "]") + " noenhanced\n";
    std::size_t lines = 0;
    for (std::size_t t = 0; t < table.traces.size(); ++t) {
      if (table.traces[t].quantity.row->unit != unit) continue;
      script += lines == 0 ? "plot " : ", ";
      append_formatted(script, "$trace%zu with lines linewidth 1.8 linecolor rgb '%s' dashtype %zu title %s", t,
                       trace_colors[lines % trace_colors.size()], 1 + lines / trace_colors.size(),
                       gnuplot_text(table.traces[t].quantity.name()).c_str());
      ++lines;
    }
    script += '\n';
  }
  return {chart_width, panels * unit_height, script + "unset multiplot\n"};
}

}  // namespace hooke
