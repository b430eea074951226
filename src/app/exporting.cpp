// Exports: at once, or for what happens in time on a thread of their own, over a copy of the scene.
#include <chrono>

#include "app/app.h"
#include "app/files.h"
#include "lab/atomic_write.h"
#include "lab/frames_file.h"
#include "lab/open_file.h"
#include "lab/printable.h"

namespace hooke {
namespace {

std::string without_extension(const std::filesystem::path& file) { return (file.parent_path() / file.stem()).string(); }

// The quantities of a list with commas between; an error text where one is none.
std::string read_quantities(const std::string& list, const System& system, std::vector<Quantity>& quantities) {
  const auto found = parse_quantities(list, system.point_count(), system.spring_count(), quantities);
  return found.empty() ? "" : "\"" + found + "\" is no quantity of this scene: must be one of " + quantity_names() + ".";
}

}  // namespace

void App::ask_export() {
  Exporting& exporting = panels_.exporting;
  if (exporting.is_running()) {
    exporting.is_shown = true;
    return;
  }
  const bool own = !file_.empty() && !is_shipped(file_);
  const std::string stem = file_.empty() ? "untitled" : file_.stem().string();
  exporting.path = own ? without_extension(file_) : without_extension(typed_path(stem));
  exporting.is_shown = exporting.is_new = true;
}

// Enter and Esc.
bool App::key_exports(const KeyPress& press) {
  Exporting& exporting = panels_.exporting;
  if (!exporting.is_shown || panels_.menu_is_open || (press.key != Key::Enter && press.key != Key::Escape)) return false;
  if (panels_.typing != 0) return false;
  if (exporting.is_running())
    exporting.wants_stop = press.key == Key::Escape;
  else if (press.key == Key::Enter)
    exporting.wants_export = true;
  else
    exporting.is_shown = false;
  return true;
}

void App::follow_export() {
  Exporting& exporting = panels_.exporting;
  if (std::exchange(exporting.wants_export, false) && !exporting.is_running()) start_export();
  if (!exporting.is_running()) return;
  if (std::exchange(exporting.wants_stop, false)) export_progress_->stop = true;
  exporting.share = export_progress_->share;
  exporting.running_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - export_started_).count();
  if (export_run_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  exporting.share = -1.0;
  finish_export(export_run_.get(), export_progress_->stop);
}

void App::start_export() {
  Exporting& exporting = panels_.exporting;
  const ExportKind& kind = export_kinds()[exporting.kind];
  const std::filesystem::path file = typed_path(exporting.path);
  if (file.extension() != kind.extension) return panels_.tell("Cannot export", "The path must end in " + std::string(kind.extension) + ".");
  if (kind.extension == ".png") {
    picture_file_ = file;
    exporting.is_shown = false;
    return;
  }

  export_file_ = file;
  if (kind.quantities && !kind.over_time) return export_plots(file);
  if (!kind.over_time) return export_as_it_stands(file);
  Scene scene = *lab_.copy_scene().get();

  FramesFile wanted{.file = file, .seconds = exporting.seconds, .quantities = {}};
  if (kind.quantities)
    if (const std::string error = read_quantities(exporting.quantities, scene.system, wanted.quantities); !error.empty())
      return panels_.tell("Cannot export", error);
  exporting.share = 0.0;
  export_started_ = std::chrono::steady_clock::now();
  export_progress_ = std::make_shared<ExportProgress>();
  export_run_ = std::async(std::launch::async, [scene = std::move(scene), wanted, progress = export_progress_]() mutable -> std::string {
    try {
      write_frames(std::move(scene), wanted, [&](double share) {
        progress->share = share;
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
  begin_work("Exporting " + printable(file.filename().native(), 60), [this, file, copy](const GoesOn&) -> LongWork::Finish {
    try {
      return [this, lost = save_any(*copy->get(), file)] {
        finish_export({}, false);
        if (!lost.empty()) panels_.tell("Exported, but not all of it", joined(lost));
      };
    } catch (const std::runtime_error& refusal) {  // Refused or FileError
      return [this, said = std::string(refusal.what())] { finish_export(said, false); };
    }
  });
}

void App::export_plots(const std::filesystem::path& file) {
  if (status().traces->traces.empty()) return panels_.tell("Cannot export", "There are no plots: show some first.");
  try {
    write_atomically(file, to_csv(*status().traces));
    finish_export({}, false);
  } catch (const FileError& error) {
    finish_export(error.what(), false);
  }
}

void App::finish_export(const std::string& error, bool stopped) {
  if (!error.empty()) return panels_.tell("Cannot export all of it", error);
  panels_.exporting.is_shown = false;
  panels_.say(stopped ? "Export stopped: nothing was written" : "Exported " + export_file_.string());
}

std::optional<std::filesystem::path> App::take_picture_file() { return std::exchange(picture_file_, std::nullopt); }

void App::note_picture(const std::filesystem::path& file, const std::string& error) {
  if (error.empty())
    panels_.say("Picture " + printable(file.native()));
  else
    panels_.tell("Cannot write the picture", error);
}

}  // namespace hooke
