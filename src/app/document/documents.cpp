// The document of the window: opened, saved, kept against a kill, watched for what others do to its file.
#include <chrono>

#include "app/app.h"
#include "app/document/files.h"
#include "base/printable.h"
#include "formats/open_file.h"
#include "lab/recording.h"

namespace hooke {
namespace {

// How often the file of the document is looked at [s].
constexpr double watch_period = 1.0;

double seconds_now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::string name_of(const std::filesystem::path& file) { return printable(file.filename().native(), 60); }

}  // namespace

void App::confirm_unsaved_then(Request request) {
  settle();
  pending_ = std::move(request);
  if (status().history.unsaved) return panels_.open_dialog(Dialog::Kind::Unsaved);
  go_on_after_saving();
}

void App::answer(Answer given) {
  switch (given) {
    case Answer::Save:
      return save();
    case Answer::Discard:
      return go_on_after_saving();
    case Answer::Cancel:
      pending_.reset();
      return;
    case Answer::Overwrite:
      return write_to(saving_to_);
    case Answer::SaveAs:
      return open_path_dialog();
    case Answer::MakeCopy:
      file_.clear();
      return begin_document();
    case Answer::Reload:
      return confirm_unsaved_then(OpenFile{file_});
    case Answer::KeepMine:
      panels_.file_notice.clear();
      watch_.take(file_);
      return;
  }
}

// There is nothing more to lose: do what was asked for.
void App::go_on_after_saving() {
  const auto request = std::exchange(pending_, std::nullopt);
  if (!request) return;
  if (const auto* open_file = std::get_if<OpenFile>(&*request)) return open(open_file->file);
  if (*std::get_if<Action>(&*request) == Action::Quit)
    finish();
  else
    take_document(std::make_shared<const Scene>(empty_scene()), {});
}

void App::finish() {
  film_recorder_.end_film();
  lab_.submit(Record{});
  settle();
  autosave_.forget();
  session_.end();
  finished_ = true;
}

void App::take_document(std::shared_ptr<const Scene> scene, std::filesystem::path file, bool unsaved) {
  take_tool(tool_action_);
  selection_ = {};
  panels_.file_warnings.clear();
  panels_.gallery.is_shown = false;
  panels_.placement.stop();
  file_ = std::move(file);
  tool_context_.camera = make_camera(scene->view, scene->system, scene->state, tool_context_.size.x / tool_context_.size.y);
  take_switches(scene->view);
  lab_.submit(Open{std::move(scene), unsaved});
  autosave_.forget();
  settle();
  begin_document();
}

// Tells the other runs, and asks when one of them has the same file open.
void App::begin_document() {
  forecaster_.forget();
  panels_.file_notice.clear();
  const bool own = !file_.empty() && !is_shipped(file_);
  watch_.take(own ? file_ : std::filesystem::path());
  session_.set_document(own ? file_ : std::filesystem::path(), status().document->name);
  if (!own) return;
  recent_.add(file_);
  if (session_.is_open_elsewhere(file_))
    panels_.queue_message("Open in another window",
                          name_of(file_) + " is open in another Hooke. What is saved there and what is saved here replace each other.",
                          {{"Open it here too", Answer::KeepMine}, {"Make a copy", Answer::MakeCopy}});
}

void App::play(std::shared_ptr<const Recording> recording) {
  take_document(recording->start, {});
  if (recording->is_truncated) panels_.file_warnings = "The recording's last line is not finished: it is played up to there.";
  lab_.submit(Play{std::move(recording)});
  lab_.submit(SetRunning{true});
}

// What is short is over at once; what is not goes on in a box of its own.
void App::begin_work(std::string what, BackgroundTask::Work work) {
  if (work_.is_running()) {
    pending_.reset();
    return panels_.show_toast("Not yet: " + work_.what());
  }
  panels_.work = {};
  work_.start(std::move(what), std::move(work));
  update_work(work_patience_);
}

void App::update_work(std::chrono::milliseconds at_most) {
  if (panels_.work.wants_stop) work_.stop();
  const bool is_over = work_.follow(at_most);
  panels_.work = {.what = work_.what(),
                  .fraction = work_.fraction(),
                  .seconds = work_.seconds(),
                  .is_running = !is_over,
                  .wants_stop = work_.was_stopped()};
  if (!is_over && panels_.dialog.kind == Dialog::Kind::None) panels_.open_dialog(Dialog::Kind::Working);
}

void App::wait_for_work() {
  while (work_.is_running()) update_work(work_patience_);
}

void App::open(const std::filesystem::path& file) {
  if (file.extension() == recording_extension) return open_recording(file);
  begin_work("Opening " + name_of(file), [this, file](const Progress& progress) -> BackgroundTask::Completion {
    return [this, file, opened = try_open(file, progress)] {
      if (work_.was_stopped()) return panels_.show_toast("Stopped: nothing was opened");
      if (!opened.scene) {
        std::error_code error;
        if (!std::filesystem::exists(file, error)) recent_.forget(file);
        return panels_.show_message("Cannot open the scene", opened.error);
      }
      // a file of another kind is taken over, not edited
      const bool imported = find_file_kind(file) != nullptr && !is_scene_file(file);
      take_document(opened.scene, imported ? std::filesystem::path() : file);
      panels_.file_warnings = opened.warnings;
    };
  });
}

void App::open_recording(const std::filesystem::path& file) {
  begin_work("Opening " + name_of(file), [this, file](const Progress&) -> BackgroundTask::Completion {
    try {
      return [this, recording = std::make_shared<const Recording>(read_recording(file))] {
        if (work_.was_stopped()) return panels_.show_toast("Stopped: nothing was opened");
        play(recording);
      };
    } catch (const std::runtime_error& error) {  // Refused or FileError
      return [this, message = std::string(error.what())] { panels_.show_message("Cannot open the recording", message); };
    }
  });
}

void App::save() {
  if (file_.empty() || is_shipped(file_)) return open_path_dialog();
  save_to(file_);
}

// Asks first where another's work would be replaced.
void App::save_to(const std::filesystem::path& file) {
  if (find_file_kind(file) != nullptr && !is_scene_file(file)) {
    pending_.reset();
    return panels_.show_message("Cannot save the scene",
                                name_of(file) + ": a scene is saved with the ending .json; other kinds are exports.");
  }
  saving_to_ = file;
  const std::vector<Choice> choices = {{"Save as...", Answer::SaveAs}, {"Replace it", Answer::Overwrite}, {"Cancel", Answer::Cancel}};
  if (file == file_ && watch_.check() == FileWatch::Change::Other)
    return panels_.show_message("The file was changed",
                                name_of(file) + " was changed by another program since it was opened here. Saving replaces that.", choices);
  if (file != file_ && session_.is_open_elsewhere(file))
    return panels_.show_message("Open in another window", name_of(file) + " is open in another Hooke. Saving replaces what is saved there.",
                                choices);
  write_to(file);
}

void App::write_to(const std::filesystem::path& file) {
  auto copy = std::make_shared<std::future<std::shared_ptr<const Scene>>>(lab_.copy_scene());
  begin_work("Saving " + name_of(file),
             [this, file, copy, add_view_settings = add_view_settings()](const Progress& progress) -> BackgroundTask::Completion {
               Scene scene = *copy->get();
               add_view_settings(scene);
               return [this, file, error = try_save(scene, file, progress)] { finish_saving(file, error); };
             });
}

void App::finish_saving(const std::filesystem::path& file, const std::string& error) {
  if (!error.empty()) {
    pending_.reset();
    if (work_.was_stopped()) return panels_.show_toast("Stopped: nothing was saved");
    return panels_.show_message("Cannot save the scene",
                                error + "\n\nNothing is lost: the scene is open as it was, and an older file is as it was.",
                                {{"Save as...", Answer::SaveAs}, {"OK", Answer::Cancel}});
  }
  const bool moved = file_ != file;
  file_ = file;
  lab_.submit(MarkSaved{});
  autosave_.forget();
  settle();
  panels_.file_notice.clear();
  watch_.take(file_);
  recent_.add(file_);
  if (moved) session_.set_document(file_, status().document->name);
  panels_.show_toast("Saved " + printable(file.native()));
  go_on_after_saving();
}

void App::open_path_dialog() {
  if (preferences_.system_dialogs && has_system_dialog_) return open_system_dialog(true);
  const bool own = !file_.empty() && !is_shipped(file_);
  const std::filesystem::path folder = start_folder();
  panels_.open_file_dialog(Dialog::Kind::Save, folder,
                           own ? file_.string() : (folder / (file_.empty() ? "untitled" : file_.stem())).string() + ".json");
}

void App::open_system_dialog(bool to_save) {
  const auto kind = to_save ? SystemDialog::Kind::Save : SystemDialog::Kind::Open;
  const bool own = !file_.empty() && !is_shipped(file_);
  const std::filesystem::path start = to_save ? start_folder() / (own ? file_.filename() : "untitled.json") : start_folder() / "";
  if (!system_dialog_.start(kind, start))
    panels_.show_message("There is no dialog of the desktop", "Neither zenity nor kdialog could be started.");
}

// Beside the document, named like it, and like nothing that is there.
std::filesystem::path App::name_for(const std::string& extension) const {
  const bool own = !file_.empty() && !is_shipped(file_);
  const std::string stem = !file_.empty() ? file_.stem().string() : "untitled";
  return free_name(own ? file_.parent_path() : start_folder(), stem, extension);
}

void App::film() {
  if (film_recorder_.is_filming())
    film_recorder_.end_film();
  else if (film_recorder_.is_writing())
    panels_.show_toast("The film before is still being written");
  else
    film_recorder_.start_film(name_for(".mp4"));
}

void App::record() {
  if (recording_.empty()) {
    recording_ = name_for(recording_extension);
    lab_.submit(Record{std::make_shared<const std::filesystem::path>(recording_)});
  } else {
    lab_.submit(Record{});
    panels_.show_toast("Recording " + printable(recording_.native()));
    recording_.clear();
  }
}

// Where the document lies, else where the last one did.
std::filesystem::path App::start_folder() const {
  if (!file_.empty() && !is_shipped(file_)) return file_.parent_path();
  std::error_code error;
  for (const std::filesystem::path& file : recent_.files())
    if (std::filesystem::is_directory(file.parent_path(), error)) return file.parent_path();
  return home_folder();
}

// What hides it gives way.
void App::choose_texture(const std::string& typed) {
  ChosenTexture chosen = try_texture(typed, file_);
  if (!chosen.error.empty()) return panels_.show_message("Cannot use the picture", chosen.error);
  if (!chosen.set.texture.empty()) {
    panels_.view.surface = true;
    panels_.view.strain_colors = panels_.view.strain_colors && panels_.view.springs;
  }
  lab_.submit(std::move(chosen.set));
}

// What the window shows of a scene is saved with it. Used by another thread: it holds copies.
std::function<void(Scene&)> App::add_view_settings() const {
  return [view = panels_.view](Scene& scene) {
    scene.view.surface = view.surface;
    scene.view.springs = view.springs;
    scene.view.points = view.points;
    scene.view.strain_colors = view.strain_colors;
    scene.view.shadows = view.shadows;
  };
}

void App::poll_background_work() {
  take_status();
  if (const std::string message = film_recorder_.take_message(); !message.empty()) panels_.show_toast(message);
  if (!status().recording.error.empty() && !std::exchange(recording_, {}).empty()) panels_.show_toast(status().recording.error);
  if (!status().recording.difference.empty() && status().recording.difference != reported_difference_)
    panels_.file_warnings = "Not as it was recorded: " + status().recording.difference;
  reported_difference_ = status().recording.difference;
  if (work_.is_running()) update_work();
  const double now = seconds_now();
  autosave_.follow(status(), lab_, now, add_view_settings());
  if (const std::string error_text = autosave_.take_error(); !error_text.empty())
    panels_.file_warnings = "Unsaved work cannot be kept against a crash: " + error_text;

  if (now >= watched_at_ + watch_period) {
    watched_at_ = now;
    watch_file();
  }

  const auto kind = system_dialog_.kind();
  const auto chosen = system_dialog_.take_answer();
  if (!chosen) return;
  if (chosen->empty())
    pending_.reset();
  else if (kind == SystemDialog::Kind::Open)
    confirm_unsaved_then(OpenFile{typed_path(*chosen)});
  else
    save_to(typed_path(*chosen));
}

// Said once; until it is answered the notice stands.
void App::watch_file() {
  const FileWatch::Change change = watch_.check();
  panels_.file_is_gone = change == FileWatch::Change::Gone;
  if (change == FileWatch::Change::None)
    panels_.file_notice.clear();
  else
    panels_.file_notice =
        name_of(file_) + (panels_.file_is_gone ? " is no longer there. Saving writes it again." : " was changed by another program.");
}

}  // namespace hooke
