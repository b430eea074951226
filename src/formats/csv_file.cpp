// Tables (.csv): quantities over time, and the plots of the window.
#include "base/atomic_write.h"
#include "base/file_limits.h"
#include "base/printable.h"
#include "formats/file_kinds.h"

namespace hooke {
namespace {

class TableSink : public FrameSink {
 public:
  TableSink(const std::filesystem::path& file, const std::vector<Quantity>& quantities)
      : file_(file), quantities_(quantities), text_(csv_heading(quantities)) {}

  void add(const System& system, const State& state, const Accuracy* accuracy) override {
    text_ += csv_row(quantities_, system, state, accuracy);
    if (text_.size() > max_file_bytes) throw InputError(printable(file_.native()) + ": more than 256 MiB: use fewer quantities or seconds");
  }
  void finish() override { write_atomically(file_, text_); }

 private:
  std::filesystem::path file_;
  std::vector<Quantity> quantities_;
  std::string text_;
};

}  // namespace

constinit const FileKind table_file{.extension = ".csv",
                                    .title = "Quantities over time",
                                    .open_frames = [](const std::filesystem::path& file, const System&,
                                                      const std::vector<Quantity>& quantities) -> std::unique_ptr<FrameSink> {
                                      return std::make_unique<TableSink>(file, quantities);
                                    },
                                    .source = ExportSource::Frames,
                                    .label = "Table",
                                    .description = "Quantities in each frame from now on.",
                                    .has_quantities = true};

constinit const FileKind plots_file{.extension = ".csv",
                                    .title = "Plots",
                                    .source = ExportSource::Plots,
                                    .label = "Plots",
                                    .description = "The plotted quantities, as far back as the history reaches."};

constinit const FileKind plots_svg_file{.extension = ".svg",
                                        .title = "Plots",
                                        .source = ExportSource::Plots,
                                        .label = "Plots as a chart",
                                        .description = "What the plots show, with gnuplot."};

constinit const FileKind plots_png_file{.extension = ".png",
                                        .title = "Plots",
                                        .source = ExportSource::Plots,
                                        .label = "Plots as a picture",
                                        .description = "What the plots show, with gnuplot."};

}  // namespace hooke
