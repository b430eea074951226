// Document: opening and saving.
#include "app/document/document.h"
#include "app/document/files.h"
#include "base/folder_listing.h"
#include "base/number_text.h"
#include "base/printable.h"
#include "formats/open_file.h"

namespace hooke {
namespace {

std::string name_of(const std::filesystem::path& file) { return printable(file.filename().native(), 60); }

std::string time_text(double seconds) { return quantity_text(seconds, "s", 4); }

std::vector<Choice> choices_to_save_elsewhere() { return {{"Save as...", Answer::SaveAs}, {"OK", Answer::Cancel}}; }

}  // namespace

void Document::ask_what_to_open() {
  if (settings_.values().system_dialogs && has_system_dialog()) return open_system_dialog(false);
  panels_.open_file_dialog(Dialog::Kind::Open, start_folder());
}

void Document::ask_where_to_save(LabThread::Moment moment) {
  saving_.moment = moment;
  if (settings_.values().system_dialogs && has_system_dialog()) return open_system_dialog(true);
  panels_.open_file_dialog(Dialog::Kind::Save, start_folder(), proposed_file().string());
  if (moment == LabThread::Moment::Present)
    panels_.dialog.title = "Save the state at t = " + time_text(status().snapshot->state.time) + " as";
}

std::filesystem::path Document::proposed_file() const {
  const std::filesystem::path folder = start_folder();
  if (saving_.moment == LabThread::Moment::Present)
    return free_name(folder, stem() + "-" + number_text(status().snapshot->state.time, 4) + "s", ".json");
  return has_own_file() ? file_ : folder / (stem() + ".json");
}

void Document::open_system_dialog(bool to_save) {
  const auto kind = to_save ? SystemDialog::Kind::Save : SystemDialog::Kind::Open;
  const std::filesystem::path start = to_save ? proposed_file() : start_folder() / "";
  if (!system_dialog_.start(kind, start)) panels_.show_message("No native file dialog found", "Install zenity or kdialog to use one.");
}

// Replaces a pending task.
void Document::start_task(std::string what, BackgroundTask::Work work) {
  if (!task_.start(std::move(what), std::move(work))) pending_ = nullptr;
}

void Document::read(const std::filesystem::path& file, const ImportOptions& options) {
  if (file.extension() == recording_extension)
    read_recording_file(file);
  else
    read_scene(file, options);
}

void Document::read_scene(const std::filesystem::path& file, const ImportOptions& options) {
  start_task("Opening " + name_of(file), [this, file, options](const Progress& progress) -> BackgroundTask::Completion {
    return [this, file, opened = try_open(file, progress, options)] {
      if (task_.was_stopped()) return panels_.show_toast("Canceled: nothing was opened");
      if (!opened.scene) {
        std::error_code error;
        if (!std::filesystem::exists(file, error)) recent_.remove(file);
        return panels_.show_message("Cannot open the scene", opened.error);
      }
      // a file of another format is imported: the document has no file
      const bool imported = find_readable_kind(file) != nullptr && !is_scene_file(file);
      replace(opened.scene, imported ? std::filesystem::path() : file);
      panels_.banners.file_warnings = opened.warnings;
      if (!opened.summary.empty()) panels_.show_toast(opened.summary);
    };
  });
}

void Document::read_recording_file(const std::filesystem::path& file) {
  start_task("Opening " + name_of(file), [this, file](const Progress&) -> BackgroundTask::Completion {
    try {
      return [this, recording = std::make_shared<const Recording>(read_recording(file))] {
        if (task_.was_stopped()) return panels_.show_toast("Canceled: nothing was opened");
        play(recording);
      };
    } catch (const std::runtime_error& error) {  // InputError or FileError
      return [this, message = std::string(error.what())] { panels_.show_message("Cannot open the recording", message); };
    }
  });
}

void Document::play(std::shared_ptr<const Recording> recording) {
  replace(recording->start, {});
  if (recording->is_truncated) panels_.banners.file_warnings = "The last line of the recording is incomplete: the replay ends before it.";
  context_.lab.submit(Play{std::move(recording)});
  context_.lab.submit(SetRunning{true});
}

void Document::save() {
  saving_.moment = LabThread::Moment::Start;
  if (!has_own_file()) return ask_where_to_save();
  save_to(file_);
}

void Document::save_to(const std::filesystem::path& file) {
  if (find_file_kind(file) != nullptr && !is_scene_file(file)) {
    pending_ = nullptr;
    return panels_.show_message("Cannot save the scene", name_of(file) + ": scenes are saved as .json; use Export for other formats.");
  }
  if (saving_.moment == LabThread::Moment::Present && file == file_)
    return panels_.show_message(
        "Choose another file", name_of(file) + " contains the start of the open scene. Use another name, or \"Set as start\" and \"Save\".",
        choices_to_save_elsewhere());
  saving_.file = file;
  const std::vector<Choice> choices = {{"Save as...", Answer::SaveAs}, {"Replace", Answer::Overwrite}, {"Cancel", Answer::Cancel}};
  if (file == file_ && watch_.check() == FileWatch::Change::Modified)
    return panels_.show_message(
        "File changed",
        name_of(file) + " was changed by another program after it was opened here. Save under another name to keep those changes.",
        choices);
  if (file != file_ && session_.is_open_elsewhere(file))
    return panels_.show_message("Open in another window",
                                name_of(file) + " is open in another Hooke window. Save under another name to keep what that window saved.",
                                choices);
  write_to(file);
}

void Document::write_to(const std::filesystem::path& file) {
  auto copy = std::make_shared<std::future<std::shared_ptr<const Scene>>>(context_.lab.copy_scene(saving_.moment));
  start_task("Saving " + name_of(file),
             [this, file, copy, add_view_settings = add_view_settings()](const Progress& progress) -> BackgroundTask::Completion {
               Scene scene = *copy->get();
               add_view_settings(scene);
               return [this, file, time = scene.state.time, error = try_save(scene, file, progress)] { finish_saving(file, time, error); };
             });
}

// `time`: of the state in the file [s].
void Document::finish_saving(const std::filesystem::path& file, double time, const std::string& error) {
  if (!error.empty()) {
    pending_ = nullptr;
    if (task_.was_stopped()) return panels_.show_toast("Canceled: nothing was saved");
    return panels_.show_message("Cannot save the scene",
                                error + "\n\nNothing is lost, and an existing file is unchanged: try another name or folder.",
                                choices_to_save_elsewhere());
  }
  const std::string shown = printable(file.native());
  if (saving_.moment == LabThread::Moment::Present)
    return panels_.show_toast("Saved the state at t = " + time_text(time) + " to " + shown + "; the open scene is unchanged");
  const bool moved = file_ != file;
  file_ = file;
  context_.lab.submit(MarkSaved{});
  autosave_.discard();
  context_.settle();
  panels_.banners.file_notice.clear();
  watch_.take(file_);
  recent_.add(file_);
  if (moved) session_.set_document(file_, status().document->name);
  const double now = status().snapshot->state.time;
  panels_.show_toast("Saved " + shown + (now == time ? "" : ": the start of the scene, not its state at t = " + time_text(now)));
  continue_after_saving();
}

}  // namespace hooke
