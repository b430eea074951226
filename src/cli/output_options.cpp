#include "cli/output_options.h"

namespace hooke {

void add_output_options(CLI::App& app, OutputOptions& options, Summary summary) {
  const bool in_summary = summary == Summary::WithErrorOfFrame;
  app.add_option("--sample", options.sample,
                 "Sample at the start and at the end of the first frame at or after each multiple of DT, without interpolation [s]; "
                 "default: only the last state")
      ->type_name("DT")
      ->transform(within(positive));
  app.add_option("--points", options.points, "Points to sample, numbered from 0; default: all")->type_name("0,5,9");
  app.add_option("--json", options.files.json, "Write the run and its samples as JSON; - for stdout")->type_name("FILE");
  app.add_option("--csv", options.files.csv, "Write one row per sample: time, energies, positions; - for stdout")->type_name("FILE");
  app.add_option("--quantities", options.files.quantities, "Columns of --csv instead: " + quantity_names())->type_name("time,total,y5");
  app.add_option("--accuracy", options.accuracy,
                 std::string("What is measured for --json") +
                     (in_summary ? ", for quantities such as error, and for the summary" : " and for quantities such as error") +
                     ": off; frame (the error of a frame and the energy balance, at a tenth of the cost of the run); full (also the "
                     "accumulated error and the growth of small differences, at two and a half times the cost); default: full where it is "
                     "written" +
                     (in_summary ? ", frame for the summary" : ""))
      ->type_name("off|frame|full")
      ->transform(one_of({"off", "frame", "full"}));  // as AccuracyMode lists them
}

}  // namespace hooke
