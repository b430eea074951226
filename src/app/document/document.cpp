#include "app/document/document.h"

#include <algorithm>
#include <chrono>

#include "app/document/files.h"
#include "base/folder_listing.h"
#include "base/printable.h"
#include "base/text_lines.h"
#include "scene/step_advice.h"

namespace hooke {
namespace {

// "nail 3 points, add 1 point (2 times), set Stiffness k to 185 N/m and 4 more"
std::string changes_text(const std::vector<std::string>& changes) {
  constexpr std::size_t max_shown = 4;
  std::string text;
  // the newest first: they are remembered best
  std::size_t left = changes.size();
  for (std::size_t i = 0; i < max_shown && left > 0; ++i) {
    const std::string& change = changes[left - 1];
    std::size_t times = 0;
    for (; left > 0 && changes[left - 1] == change; --left) ++times;
    text += (i == 0 ? "" : ", ") + printable(change, 60) + (times > 1 ? " (" + std::to_string(times) + " times)" : "");
  }
  if (left > 0) text += " and " + std::to_string(left) + " more";
  return "Not saved yet: " + text + ".";
}

double seconds_now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

Document::Document(ToolContext& context, Panels& panels, FileTask& task, const UserSettings& settings, const Home& home,
                   std::filesystem::path file, Show show)
    : context_(context),
      panels_(panels),
      task_(task),
      settings_(settings),
      show_(std::move(show)),
      file_(std::move(file)),
      recent_(home.state),
      session_(home.state.empty() ? home.state : home.state / "runs"),
      autosave_(session_) {
  autosave_.set_interval(settings.values().autosave_seconds);
  list_recoverable();
  if (!recoverable_.empty()) panels_.waiting.push_back({.kind = Dialog::Kind::Recovery, .is_new = true});
  begin();
}

void Document::create(int dimensions) {
  confirm_unsaved_then([this, dimensions] { replace(std::make_shared<const Scene>(empty_scene(dimensions)), {}); });
}

void Document::open(const std::filesystem::path& file, const ImportOptions& options) {
  confirm_unsaved_then([this, file, options] { read(file, options); });
}

void Document::close(std::function<void()> finish) { confirm_unsaved_then(std::move(finish)); }

void Document::confirm_unsaved_then(std::function<void()> next) {
  context_.settle();
  pending_ = std::move(next);
  if (!status().history.unsaved) return continue_after_saving();
  const std::string name = status().document->name.empty() ? "Untitled" : printable(status().document->name, 60);
  panels_.open_dialog(Dialog::Kind::Unsaved);
  panels_.dialog.text = changes_text(status().history.list->unsaved);
  panels_.dialog.title = "Save changes to \"" + (has_own_file() ? file_.stem().string() : name) + "\"?";
}

void Document::continue_after_saving() {
  if (const auto next = std::exchange(pending_, nullptr)) next();
}

void Document::answer(Answer given) {
  switch (given) {
    case Answer::Save:
      return save();
    case Answer::Discard:
      return continue_after_saving();
    case Answer::Cancel:
      pending_ = nullptr;
      return;
    case Answer::Overwrite:
      return write_to(saving_.file);
    case Answer::SaveAs:
      return ask_where_to_save(saving_.moment);
    case Answer::MakeCopy:
      file_.clear();
      return begin();
    case Answer::Reload:
      return open(file_);
    case Answer::KeepMine:
      panels_.banners.file_notice.clear();
      watch_.take(file_);
      return;
  }
}

void Document::replace(std::shared_ptr<const Scene> scene, std::filesystem::path file, bool unsaved) {
  panels_.banners.file_warnings.clear();
  settings_warnings_ = {-1, {}};
  file_ = std::move(file);
  show_(*scene);
  context_.lab.submit(Open{std::move(scene), unsaved});
  autosave_.discard();
  context_.settle();
  begin();
}

// Announces the document to other runs of Hooke, and asks if one of them has the same file open.
void Document::begin() {
  panels_.banners.file_notice.clear();
  const bool own = has_own_file();
  watch_.take(own ? file_ : std::filesystem::path());
  session_.set_document(own ? file_ : std::filesystem::path(), status().document->name);
  if (!own) return;
  recent_.add(file_);
  if (session_.is_open_elsewhere(file_))
    panels_.queue_message("Open in another window",
                          printable(file_.filename().native(), 60) +
                              " is open in another Hooke window. Make a copy, so that neither window replaces what the other one saves.",
                          {{"Open here too", Answer::KeepMine}, {"Make a copy", Answer::MakeCopy}});
}

void Document::poll() {
  report_replay_difference();
  follow_settings_warnings();
  const double now = seconds_now();
  autosave_.follow(status(), context_.lab, now, add_view_settings());
  if (const std::string error_text = autosave_.take_error(); !error_text.empty())
    panels_.banners.file_warnings = "Autosave failed: " + error_text;
  if (const auto change = watch_.check_at(now)) report_change(*change);
  poll_system_dialog();
}

// What the opened file is warned about stays only for as long as it is true.
void Document::follow_settings_warnings() {
  std::string& shown = panels_.banners.file_warnings;
  const long edits = status().history.edits;
  if (shown.empty() || settings_warnings_.first == edits) return;
  const Snapshot& now = *status().snapshot;
  std::vector<std::string> warnings = settings_warnings(*now.system, now.state, now.settings), lines;
  const std::vector<std::string_view> all = split(shown, '\n');
  for (const std::string_view line : all)
    if (std::ranges::count(settings_warnings_.second, line) == 0) lines.emplace_back(line);
  if (lines.size() < all.size()) lines.insert(lines.end(), warnings.begin(), warnings.end());
  shown = joined(lines);
  settings_warnings_ = {edits, std::move(warnings)};
}

void Document::report_replay_difference() {
  const std::string& difference = status().recording.difference;
  if (!difference.empty() && difference != reported_difference_)
    panels_.banners.file_warnings = "The replay differs from the recording: " + difference;
  reported_difference_ = difference;
}

// The notice stays until the user responds.
void Document::report_change(FileWatch::Change change) {
  panels_.banners.file_is_missing = change == FileWatch::Change::Deleted;
  if (change == FileWatch::Change::None)
    panels_.banners.file_notice.clear();
  else
    panels_.banners.file_notice =
        printable(file_.filename().native(), 60) +
        (panels_.banners.file_is_missing ? " no longer exists. Save to create it again." : " was changed by another program.");
}

void Document::poll_system_dialog() {
  const auto kind = system_dialog_.kind();
  const auto chosen = system_dialog_.take_answer();
  if (!chosen) return;
  if (chosen->empty())
    pending_ = nullptr;
  else if (kind == SystemDialog::Kind::Open)
    open(typed_path(*chosen));
  else
    save_to(typed_path(*chosen));
}

void Document::end() {
  autosave_.discard();
  session_.end();
}

bool Document::has_own_file() const { return !file_.empty() && !is_shipped(file_); }

std::string Document::title() const {
  const std::string& name = status().document->name;
  const std::string shown = has_own_file() ? file_.stem().string() : name.empty() ? "Untitled" : name;
  return "Hooke - " + shown + (status().history.unsaved ? "*" : "");
}

std::string Document::stem() const {
  if (!file_.empty()) return file_.stem().string();
  std::string name = status().document->name;
  std::ranges::replace(name, '/', '_');
  constexpr std::size_t longest = 32;  // longer ones are sentences, and do not fit in the fields of paths
  return name.empty() || name.size() > longest ? "untitled" : name;
}

std::filesystem::path Document::new_file_beside(const std::string& extension) const {
  return free_name(has_own_file() ? file_.parent_path() : start_folder(), stem(), extension);
}

// The folder of the document, or else the folder of the most recent file.
std::filesystem::path Document::start_folder() const {
  if (has_own_file()) return file_.parent_path();
  std::error_code error;
  for (const std::filesystem::path& file : recent_.files())
    if (std::filesystem::is_directory(file.parent_path(), error)) return file.parent_path();
  return home_folder();
}

// The view of the window is saved with the scene. The result runs on another thread, so it holds a copy.
std::function<void(Scene&)> Document::add_view_settings() const {
  return [view = panels_.view](Scene& scene) { copy_visible_parts(view, scene.view); };
}

}  // namespace hooke
