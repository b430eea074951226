// Document: opening and saving.
#include "app/document/document.h"
#include "app/document/files.h"
#include "base/printable.h"
#include "formats/open_file.h"

namespace hooke {
namespace {

std::string name_of(const std::filesystem::path& file) { return printable(file.filename().native(), 60); }

}  // namespace

void Document::ask_what_to_open() {
  if (settings_.values().system_dialogs && has_system_dialog_) return open_system_dialog(false);
  panels_.open_file_dialog(Dialog::Kind::Open, start_folder());
}

void Document::ask_where_to_save() {
  if (settings_.values().system_dialogs && has_system_dialog_) return open_system_dialog(true);
  const std::filesystem::path folder = start_folder();
  panels_.open_file_dialog(Dialog::Kind::Save, folder,
                           has_own_file() ? file_.string() : (folder / (file_.empty() ? "untitled" : file_.stem())).string() + ".json");
}

void Document::open_system_dialog(bool to_save) {
  const auto kind = to_save ? SystemDialog::Kind::Save : SystemDialog::Kind::Open;
  const std::filesystem::path start =
      to_save ? start_folder() / (has_own_file() ? file_.filename() : "untitled.json") : start_folder() / "";
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
      panels_.file_warnings = opened.warnings;
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
  if (recording->is_truncated) panels_.file_warnings = "The last line of the recording is incomplete: the replay ends before it.";
  context_.lab.submit(Play{std::move(recording)});
  context_.lab.submit(SetRunning{true});
}

void Document::save() {
  if (!has_own_file()) return ask_where_to_save();
  save_to(file_);
}

void Document::save_to(const std::filesystem::path& file) {
  if (find_file_kind(file) != nullptr && !is_scene_file(file)) {
    pending_ = nullptr;
    return panels_.show_message("Cannot save the scene", name_of(file) + ": scenes are saved as .json; use Export for other formats.");
  }
  saving_to_ = file;
  const std::vector<Choice> choices = {{"Save as...", Answer::SaveAs}, {"Replace", Answer::Overwrite}, {"Cancel", Answer::Cancel}};
  if (file == file_ && watch_.check() == FileWatch::Change::Modified)
    return panels_.show_message("File changed",
                                name_of(file) + " was changed by another program after it was opened here. Saving replaces those changes.",
                                choices);
  if (file != file_ && session_.is_open_elsewhere(file))
    return panels_.show_message("Open in another window",
                                name_of(file) + " is open in another Hooke window. Saving replaces what that window saved.", choices);
  write_to(file);
}

void Document::write_to(const std::filesystem::path& file) {
  auto copy = std::make_shared<std::future<std::shared_ptr<const Scene>>>(context_.lab.copy_scene());
  start_task("Saving " + name_of(file),
             [this, file, copy, add_view_settings = add_view_settings()](const Progress& progress) -> BackgroundTask::Completion {
               Scene scene = *copy->get();
               add_view_settings(scene);
               return [this, file, error = try_save(scene, file, progress)] { finish_saving(file, error); };
             });
}

void Document::finish_saving(const std::filesystem::path& file, const std::string& error) {
  if (!error.empty()) {
    pending_ = nullptr;
    if (task_.was_stopped()) return panels_.show_toast("Canceled: nothing was saved");
    return panels_.show_message("Cannot save the scene",
                                error + "\n\nNothing is lost: the scene is still open, and an existing file is unchanged.",
                                {{"Save as...", Answer::SaveAs}, {"OK", Answer::Cancel}});
  }
  const bool moved = file_ != file;
  file_ = file;
  context_.lab.submit(MarkSaved{});
  autosave_.discard();
  context_.settle();
  panels_.file_notice.clear();
  watch_.take(file_);
  recent_.add(file_);
  if (moved) session_.set_document(file_, status().document->name);
  panels_.show_toast("Saved " + printable(file.native()));
  continue_after_saving();
}

}  // namespace hooke
