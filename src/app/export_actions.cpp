// Exports: at once, or for what happens in time on a thread of their own, over a copy of the scene.
#include <chrono>

#include "app/app.h"
#include "app/document/files.h"
#include "base/atomic_write.h"
#include "base/printable.h"
#include "formats/open_file.h"
#include "study/frame_export.h"

namespace hooke {
namespace {

std::string without_extension(const std::filesystem::path& file) { return (file.parent_path() / file.stem()).string(); }

// The quantities of a list with commas between; an error text where one is none.
std::string read_quantities(const std::string& list, const System& system, std::vector<Quantity>& quantities) {
  const auto found = parse_quantities(list, system.point_count(), system.spring_count(), quantities);
  return found.empty() ? "" : "\"" + found + "\" is no quantity of this scene: must be one of " + quantity_names() + ".";
}

}  // namespace

void App::open_export_dialog() {
  ExportState& export_state = panels_.export_state;
  if (export_state.is_running()) {
    export_state.is_shown = true;
    return;
  }
  const bool own = !file_.empty() && !is_shipped(file_);
  const std::string stem = file_.empty() ? "untitled" : file_.stem().string();
  export_state.path = own ? without_extension(file_) : without_extension(typed_path(stem));
  export_state.is_shown = export_state.is_new = true;
}

// Enter and Esc.
bool App::handle_export_key(const KeyPress& press) {
  ExportState& export_state = panels_.export_state;
  if (!export_state.is_shown || panels_.menu_is_open || (press.key != Key::Enter && press.key != Key::Escape)) return false;
  if (panels_.typing != 0) return false;
  if (export_state.is_running())
    export_state.wants_stop = press.key == Key::Escape;
  else if (press.key == Key::Enter)
    export_state.wants_export = true;
  else
    export_state.is_shown = false;
  return true;
}

void App::update_export() {
  ExportState& export_state = panels_.export_state;
  if (std::exchange(export_state.wants_export, false) && !export_state.is_running()) start_export();
  if (!export_state.is_running()) return;
  if (std::exchange(export_state.wants_stop, false)) export_progress_->stop = true;
  export_state.fraction = export_progress_->fraction;
  export_state.running_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - export_started_).count();
  if (export_run_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  export_state.fraction = -1.0;
  finish_export(export_run_.get(), export_progress_->stop);
}

void App::start_export() {
  ExportState& export_state = panels_.export_state;
  const FileKind& kind = export_kinds()[export_state.kind];
  const std::filesystem::path file = typed_path(export_state.path);
  if (file.extension() != kind.extension)
    return panels_.show_message("Cannot export", "The path must end in " + std::string(kind.extension) + ".");
  if (kind.source == ExportSource::Picture) {
    picture_file_ = file;
    export_state.is_shown = false;
    return;
  }

  export_file_ = file;
  if (kind.source == ExportSource::Plots) return export_plots(file);
  if (kind.source == ExportSource::Scene) return export_as_it_stands(file);
  Scene scene = *lab_.copy_scene().get();

  FrameExport wanted{.file = file, .seconds = export_state.seconds, .quantities = {}};
  if (kind.has_quantities)
    if (const std::string error = read_quantities(export_state.quantities, scene.system, wanted.quantities); !error.empty())
      return panels_.show_message("Cannot export", error);
  export_state.fraction = 0.0;
  export_started_ = std::chrono::steady_clock::now();
  export_progress_ = std::make_shared<ExportProgress>();
  export_run_ = std::async(std::launch::async, [scene = std::move(scene), wanted, progress = export_progress_]() mutable -> std::string {
    try {
      write_frames(std::move(scene), wanted, [&](double fraction) {
        progress->fraction = fraction;
        return !progress->stop;
      });
      return {};
    } catch (const std::runtime_error& refusal) {  // Refused or FileError
      return refusal.what();
    }
  });
}

void App::export_as_it_stands(const std::filesystem::path& file) {
  auto copy = std::make_shared<std::future<std::shared_ptr<const Scene>>>(lab_.copy_scene());
  begin_work("Exporting " + printable(file.filename().native(), 60), [this, file, copy](const Progress&) -> BackgroundTask::Completion {
    try {
      return [this, losses = write_scene_as(*copy->get(), file)] {
        finish_export({}, false);
        if (!losses.empty()) panels_.show_message("Exported, but not all of it", joined(losses));
      };
    } catch (const std::runtime_error& refusal) {  // Refused or FileError
      return [this, message = std::string(refusal.what())] { finish_export(message, false); };
    }
  });
}

void App::export_plots(const std::filesystem::path& file) {
  if (status().timeline.traces->traces.empty()) return panels_.show_message("Cannot export", "There are no plots: show some first.");
  try {
    write_atomically(file, to_csv(*status().timeline.traces));
    finish_export({}, false);
  } catch (const FileError& error) {
    finish_export(error.what(), false);
  }
}

void App::finish_export(const std::string& error, bool stopped) {
  if (!error.empty()) return panels_.show_message("Cannot export all of it", error);
  panels_.export_state.is_shown = false;
  panels_.show_toast(stopped ? "Export stopped: nothing was written" : "Exported " + export_file_.string());
}

std::optional<std::filesystem::path> App::take_picture_file() { return std::exchange(picture_file_, std::nullopt); }

void App::report_picture(const std::filesystem::path& file, const std::string& error) {
  if (error.empty())
    panels_.show_toast("Picture " + printable(file.native()));
  else
    panels_.show_message("Cannot write the picture", error);
}

}  // namespace hooke
