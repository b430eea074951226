#include "app/media/exporter.h"

#include "app/document/files.h"
#include "base/atomic_write.h"
#include "base/printable.h"
#include "formats/file_kinds.h"
#include "formats/open_file.h"
#include "formats/point_cache.h"
#include "study/frame_export.h"
#include "study/plot_chart.h"
#include "study/spectrum.h"

namespace hooke {
namespace {

std::string without_extension(const std::filesystem::path& file) { return (file.parent_path() / file.stem()).string(); }

// Parses a comma-separated list. Returns an error text if a name is unknown.
std::string read_quantities(const std::string& list, const System& system, std::vector<Quantity>& quantities) {
  const auto unknown = parse_quantities(list, system.point_count(), system.spring_count(), quantities);
  if (unknown.empty()) return "";
  const std::string in_range = names_in_range(unknown, system.point_count(), system.spring_count());
  return "\"" + unknown + "\" is not a quantity of this scene; it must be " + (in_range.empty() ? "one of " + quantity_names() : in_range) +
         ".";
}

}  // namespace

void Exporter::show() {
  ExportState& state = panels_.export_state;
  state.is_shown = true;
  if (is_running()) return;
  state.is_new = true;
  const std::filesystem::path free_file = document_.new_file_beside(std::string(export_kinds()[state.kind].extension));
  state.path = without_extension(document_.has_own_file() ? document_.file() : free_file);
}

void Exporter::start() {
  if (is_running()) return;
  ExportState& state = panels_.export_state;
  const FileKind& kind = export_kinds()[state.kind];
  file_ = typed_path(state.path);
  if (file_.extension() != kind.extension)
    return panels_.show_message("Cannot export", "The path must end in " + std::string(kind.extension) + ".");
  if (kind.source == ExportSource::Frames) return export_frames(kind);
  if (kind.source == ExportSource::Plots) return export_plots();
  if (kind.source == ExportSource::Scene) return export_state();
  state.is_shown = false;
  if (kind.source == ExportSource::Picture) return captures_.take_picture(file_, state.picture);
  PictureOptions options = state.picture;
  options.transparent = options.transparent && kind.has_alpha;
  captures_.start_film(file_, options);
  context_.lab.submit(SetRunning{true});
}

void Exporter::export_frames(const FileKind& kind) {
  const ExportState& state = panels_.export_state;
  Scene scene = *context_.lab.copy_scene(LabThread::Moment::Present).get();
  FrameExport wanted{.file = file_, .seconds = state.seconds, .quantities = {}};
  if (kind.has_quantities)
    if (const std::string error = read_quantities(state.quantities, scene.system, wanted.quantities); !error.empty())
      return panels_.show_message("Cannot export", error);
  if (const auto warning = point_cache_warning(scene.state); warning && &kind == &pc2_file) panels_.banners.file_warnings = *warning;
  run_.start("Exporting", [this, scene = std::move(scene), wanted](const Progress& progress) -> BackgroundTask::Completion {
    std::string error;
    try {
      write_frames(scene, wanted, progress);
    } catch (const std::runtime_error& refusal) {  // InputError or FileError
      error = refusal.what();
    }
    return [this, error] { finish(error, run_.was_stopped()); };
  });
}

void Exporter::export_state() {
  auto copy = std::make_shared<std::future<std::shared_ptr<const Scene>>>(context_.lab.copy_scene(LabThread::Moment::Present));
  task_.start("Exporting " + printable(file_.filename().native(), 60),
              [this, file = file_, copy](const Progress&) -> BackgroundTask::Completion {
                try {
                  return [this, losses = write_scene_as(*copy->get(), file)] {
                    finish({}, false);
                    if (!losses.empty()) panels_.show_message("Exported with losses", joined(losses));
                  };
                } catch (const std::runtime_error& refusal) {  // InputError or FileError
                  return [this, message = std::string(refusal.what())] { finish(message, false); };
                }
              });
}

void Exporter::export_plots() {
  const TraceTable& traces = *context_.status->timeline.traces;
  if (traces.traces.empty() || traces.times.empty())
    return panels_.show_message("Cannot export", "There are no plots: press P to show some first.");
  try {
    if (file_.extension() == ".csv") {
      write_atomically(file_, to_csv(traces));
      return finish({}, false);
    }
    auto [first, last] = shown_times(traces, panels_);
    const bool is_spectrum = panels_.plots.shows_spectrum;
    const TraceTable shown = is_spectrum ? spectrum_of(traces, first, last) : traces;
    if (is_spectrum) first = 0.0, last = shown.times.empty() ? 1.0 : shown.times.back();
    finish(draw_chart(plot_chart(shown, first, last, is_spectrum), file_).value_or(""), false);
  } catch (const FileError& error) {
    finish(error.what(), false);
  }
}

ExportWork Exporter::progress() const {
  return is_running() ? ExportWork{.fraction = run_.fraction(), .seconds = run_.seconds(), .is_running = true} : ExportWork{};
}

void Exporter::finish(const std::string& error, bool stopped) {
  if (!error.empty()) return panels_.show_message("Export failed", error);
  panels_.export_state.is_shown = false;
  panels_.show_toast(stopped ? "Export stopped: nothing was written" : "Exported " + file_.string());
}

}  // namespace hooke
