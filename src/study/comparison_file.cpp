#include "study/comparison_file.h"

#include "base/atomic_write.h"
#include "base/printable.h"
#include "study/gnuplot.h"
#include "study/work_precision_chart.h"

namespace hooke {

std::string write_comparison(const MethodComparison& comparison, const std::filesystem::path& file) {
  const Results results{.conditions = {}, .date = {}, .problems = {comparison.record}};
  const std::filesystem::path extension = file.extension();
  try {
    if (extension == ".csv") {
      write_atomically(file, format_csv(results));
    } else if (extension == ".json") {
      write_atomically(file, format_results(results));
    } else if (extension == ".svg" || extension == ".png") {
      const ChartFormat format = extension == ".svg" ? ChartFormat::Svg : ChartFormat::Png;
      return draw_chart(chart_script(results, format), file).value_or("");
    } else {
      return "no such format: must be .svg, .png, .csv or .json";
    }
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace hooke
