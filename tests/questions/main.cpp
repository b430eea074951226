// Measures the answers of docs/guide/questions.md and draws their charts into a folder: questions DIR. Exits with code 1 if a measurement
// contradicts the page.
#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "question.h"
#include "study/gnuplot.h"

namespace hooke {
namespace {

struct Question {
  const char* name;
  Answer (*measure)();
};

constexpr std::array questions{
    Question{"dashpots", why_dashpots_scale},  Question{"drag", why_drag_is_an_exponential},
    Question{"race", why_a_pass_must_end},     Question{"constants", why_large_constants_explode},
    Question{"mouse", what_a_fast_mouse_does}, Question{"energy", why_explicit_euler_gains_energy},
};

// Okabe and Ito 2008, legible in print and with color vision deficiencies.
constexpr std::array colors{"#0072B2", "#D55E00", "#009E73", "#000000", "#CC79A7", "#E69F00", "#56B4E9", "#5B5B5B"};

GnuplotChart make_chart(const Chart& chart) {
  std::ostringstream script;
  script << "set termoption noenhanced\nset termoption font 'DejaVu Sans,13'\nset title '" << chart.title << "'\nset xlabel '" << chart.x
         << "'\nset ylabel '" << chart.y
         << "'\nset grid lc rgb '#dddddd'\nset border 3\nset tics nomirror\nset rmargin 36\nset key at screen 0.68,0.9 left top Left "
            "reverse spacing 1.3\n";
  if (chart.log_x) script << "set logscale x\nset format x '%g'\n";
  if (chart.log_y) script << "set logscale y\nset format y '%.0e'\n";
  if (!chart.y_range.empty()) script << "set yrange " << chart.y_range << "\n";
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    script << "$data" << s << " << END\n";
    for (const auto& [x, y] : chart.series[s].points) script << x << ' ' << y << "\n";
    script << "END\n";
  }
  script << "plot ";
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const bool has_marks = chart.series[s].points.size() < 40;
    script << (s > 0 ? ", " : "") << "$data" << s << " with " << (has_marks ? "linespoints pt 7 ps 0.6" : "lines") << " lw "
           << 2 + (chart.series.size() - s) / 2 << " lc rgb '" << colors[s % colors.size()] << "' title '" << chart.series[s].name << "'";
  }
  script << "\n";
  return {900, 440, script.str()};
}

int answer_all(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  int broken = 0;
  for (const Question& question : questions) {
    const Answer answer = question.measure();
    const std::string file = std::string("question_") + question.name + ".svg";
    if (const auto failure = draw_chart(make_chart(answer.chart), folder / file)) {
      std::cerr << *failure << "\n";
      return 5;
    }
    std::cout << question.name << ": " << answer.chart.title << "\n";
    for (const Series& series : answer.chart.series)
      std::cout << "  " << series.name << ": " << series.points.front().second << " ... " << series.points.back().second << "\n";
    for (const std::string& claim : answer.broken) {
      std::cerr << question.name << ": contradicted by the measurement: " << claim << "\n";
      broken = 1;
    }
  }
  return broken;
}

}  // namespace
}  // namespace hooke

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: questions DIR\n";
    return 2;
  }
  try {
    return hooke::answer_all(arguments[1]);
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << error.what() << "\n";
    return 5;
  }
}
