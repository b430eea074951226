// The open document: its file, saving and opening, unsaved changes, recent files, autosave and recovery, and changes of the file
// by other programs.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/document/autosave.h"
#include "app/document/file_watch.h"
#include "app/document/session.h"
#include "app/document/system_dialog.h"
#include "app/document/user_settings.h"
#include "app/tools/tool_context.h"
#include "app/work/file_task.h"
#include "lab/recording.h"

namespace hooke {

class Document {
 public:
  // Called with a scene just before it replaces the one on screen.
  using Show = std::function<void(const Scene&)>;

  // Without a home nothing is saved between runs. An empty file: the scene has none.
  Document(ToolContext& context, Panels& panels, FileTask& task, const UserSettings& settings, const Home& home, std::filesystem::path file,
           Show show);

  // Each of these asks about unsaved changes first.
  // An empty scene in 2 or 3 dimensions.
  void create(int dimensions);
  void open(const std::filesystem::path& file, const ImportOptions& options = {});
  void close(std::function<void()> finish);
  // The user's answer to a question of this class.
  void answer(Answer given);

  void ask_what_to_open();
  // A file contains the start of the scene; the state of a run is saved to another one.
  void ask_where_to_save(LabThread::Moment moment = LabThread::Moment::Start);
  void open_system_dialog(bool to_save);
  void save();
  // Asks first if that would replace changes made by other programs.
  void save_to(const std::filesystem::path& file);
  // Plays a recording from its start.
  void play(std::shared_ptr<const Recording> recording);

  // Opens or deletes an autosave, by its index in recovery_entries().
  void recover(std::size_t which);
  void discard_recovery(std::size_t which);

  // Once per frame, visible or not: autosave, file watch, the system file dialog.
  void poll();
  // The run ends: nothing is left to recover.
  void end();

  const std::filesystem::path& file() const { return file_; }
  // Where file dialogs start.
  std::filesystem::path start_folder() const;
  // Whether the file is the user's own, not a shipped scene.
  bool has_own_file() const;
  std::string title() const;
  // The stem of proposed file names: that of the present file, or the title.
  std::string stem() const;
  // A new file in the folder of the document, with its name.
  std::filesystem::path new_file_beside(const std::string& extension) const;
  const std::vector<std::filesystem::path>& recent_files() const { return recent_.files(); }
  const std::vector<RecoveryEntry>& recovery_entries() const { return recovery_entries_; }
  bool has_system_dialog() const { return system_dialog_.is_installed(); }

 private:
  const Status& status() const { return *context_.status; }
  void confirm_unsaved_then(std::function<void()> next);
  void continue_after_saving();
  void replace(std::shared_ptr<const Scene> scene, std::filesystem::path file, bool unsaved = false);
  void begin();
  void start_task(std::string what, BackgroundTask::Work work);
  void read(const std::filesystem::path& file, const ImportOptions& options);
  void read_scene(const std::filesystem::path& file, const ImportOptions& options);
  void read_recording_file(const std::filesystem::path& file);
  std::filesystem::path proposed_file() const;
  void write_to(const std::filesystem::path& file);
  void finish_saving(const std::filesystem::path& file, double time, const std::string& error);
  std::function<void(Scene&)> add_view_settings() const;
  void report_replay_difference();
  void follow_settings_warnings();
  void report_change(FileWatch::Change change);
  void poll_system_dialog();
  void list_recoverable();

  ToolContext& context_;
  Panels& panels_;
  FileTask& task_;
  const UserSettings& settings_;
  Show show_;

  std::filesystem::path file_;  // empty if there is none
  struct Saving {
    std::filesystem::path file;  // pending until the user decides about changes made by other programs
    LabThread::Moment moment = LabThread::Moment::Start;
  };
  Saving saving_;
  std::function<void()> pending_;  // pending until the user decides about unsaved changes

  RecentFiles recent_;
  Session session_;
  Autosave autosave_;
  FileWatch watch_;
  SystemDialog system_dialog_;
  std::string reported_difference_;
  // The warnings about the settings of the scene, as it is after so many edits; -1: they are not known yet.
  std::pair<long, std::vector<std::string>> settings_warnings_{-1, {}};
  std::vector<RecoverableScene> recoverable_;
  std::vector<RecoveryEntry> recovery_entries_;  // the same, for the panels
};

}  // namespace hooke
