// The program of the window, without the window: events and frames in, commands out, and what there is to draw.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/background_task.h"
#include "app/clipboard.h"
#include "app/document/autosave.h"
#include "app/document/file_watch.h"
#include "app/document/home.h"
#include "app/document/preferences.h"
#include "app/document/session.h"
#include "app/document/system_dialog.h"
#include "app/forecaster.h"
#include "app/media/film_recorder.h"
#include "app/placement_part.h"
#include "app/tools/tools.h"
#include "app/tools/tune.h"
#include "app/window/event.h"
#include "ui/panels.h"

namespace hooke {

// Measured by the window's loop.
struct FrameStatistics {
  double frames_per_second = 0.0, draw_ms = 0.0;
};

class App {
 public:
  // `file`: where the scene came from; empty: from nowhere. Without a home nothing is kept between runs.
  App(std::shared_ptr<const Scene> scene, std::filesystem::path file, const Home& home = {});

  // The window's size and its content scale. The first call frames the scene.
  void resize(const glm::dvec2& size, double scale);
  void handle(const Event& event);
  // Once a frame, between ImGui::NewFrame and ImGui::Render: the tool follows the cursor, the panels are built and obeyed.
  void build_frame(const FrameStatistics& frame_statistics);
  // What goes on while the window is not seen too: unsaved work is kept, the file of the document watched.
  void poll_background_work();

  const Status& status() const { return *tool_context_.status; }
  const Camera& camera() const { return tool_context_.camera; }
  const Layout& layout() const { return layout_; }
  ViewOptions view_options() const;
  const Marks& marks() const { return marks_; }
  std::string title() const;
  bool is_finished() const { return finished_; }
  // Nothing moves by itself: the loop may wait for the next event.
  bool is_idle() const;

  // Without one, copies stay within the program.
  void use(Clipboard clipboard) { clipboard_ = std::move(clipboard); }
  // Of the panels, besides the screen's own.
  double interface_scale() const { return preferences_.interface_scale; }

  // A picture of the scene that is to be written, asked for once; and what came of it.
  std::optional<std::filesystem::path> take_picture_file();
  void report_picture(const std::filesystem::path& file, const std::string& error);

  FilmRecorder& film_recorder() { return film_recorder_; }
  // A recording is played from its start.
  void play(std::shared_ptr<const Recording> recording);
  Panels& panels() { return panels_; }
  const Selection& selection() const { return selection_; }
  Action tool() const { return tool_action_; }
  // Waits until what was asked of the laboratory is done, and takes its newest status.
  void settle();
  // The same for a file that is being read or written. For less than `patience` the window waits, and shows nothing of it.
  void wait_for_work();
  void set_work_patience(std::chrono::milliseconds patience) { work_patience_ = patience; }

 private:
  void on(const KeyPress& press);
  void on(const ButtonPress& press);
  void on(const ButtonRelease& release);
  void on(const CursorMove& move);
  void on(const Scroll& scroll);
  void on(const FileDrop& drop);
  void on(const CloseRequest&);

  bool search(const KeyPress& press);
  void perform(Action action, bool repeated = false);
  void handle(const Request& request);
  void tune(const Tuning& tuning, bool repeated);
  void take_tool(Action action);
  void cancel();
  void open_export_dialog();
  bool handle_export_key(const KeyPress& press);
  void update_export();
  void start_export();
  void export_as_it_stands(const std::filesystem::path& file);
  void export_plots(const std::filesystem::path& file);
  void finish_export(const std::string& error, bool stopped);
  bool handle_placement_key(const KeyPress& press);
  void update_placement();
  void read_mesh(const std::filesystem::path& file);
  void place();
  void delete_selection();
  void release_nails();
  void frame_selection();
  void look_from(const Vec3& direction);
  void copy_camera();
  void paste_camera();

  // Parts of the scene, as text.
  enum class AfterCopy { Keep, Delete };
  void copy(AfterCopy after_copy = AfterCopy::Keep);
  void paste();
  void paste(const Scene& part);
  void duplicate();
  void insert_part(const Scene& part, const Vec3& displacement);

  // Does it now, or after the person was asked about unsaved changes.
  void confirm_unsaved_then(Request request);
  void take_document(std::shared_ptr<const Scene> scene, std::filesystem::path file, bool unsaved = false);
  void begin_document();
  void open(const std::filesystem::path& file);
  void open_recording(const std::filesystem::path& file);
  void save();
  void save_to(const std::filesystem::path& file);
  void write_to(const std::filesystem::path& file);
  void finish_saving(const std::filesystem::path& file, const std::string& error);
  void begin_work(std::string what, BackgroundTask::Work work);
  void update_work(std::chrono::milliseconds at_most = std::chrono::milliseconds(0));
  std::filesystem::path name_for(const std::string& extension) const;
  void film();
  void record();
  void open_path_dialog();
  void open_system_dialog(bool to_save);
  std::filesystem::path start_folder() const;
  void choose_texture(const std::string& typed);
  void answer(Answer answer);
  void go_on_after_saving();
  void finish();

  // What happens to a document besides: kept, changed by others, left by a run that was killed.
  void watch_file();
  void recover(std::size_t which);
  void discard_recovery(std::size_t which);
  void list_recoverable();
  void scale_panels(double factor);
  void keep_preferences();
  std::function<void(Scene&)> add_view_settings() const;

  void take_status();
  void take_switches(const ViewSettings& view);
  Pointer pointer() const;

  LabThread lab_;
  Selection selection_;
  Gesture last_gesture_ = 0;
  ToolContext tool_context_;

  std::unique_ptr<Tool> tool_;
  Action tool_action_ = Action::SelectTool;
  bool tool_is_pressed_ = false;
  std::optional<Button> turning_with_;  // the button that moves the camera
  glm::dvec2 cursor_{0.0};              // in window coordinates
  Modifiers modifiers_;

  std::shared_ptr<const Scene> mesh_;  // that is being placed
  bool moves_placement_ = false;

  struct ExportProgress {
    std::atomic<double> fraction = 0.0;
    std::atomic<bool> stop = false;
  };
  std::shared_ptr<ExportProgress> export_progress_;
  std::filesystem::path export_file_;
  std::chrono::steady_clock::time_point export_started_{};
  std::optional<std::filesystem::path> picture_file_;

  Panels panels_;
  Layout layout_;
  Marks marks_;
  Clipboard clipboard_;
  std::string own_clipboard_;

  Home home_;
  Preferences preferences_;
  RecentFiles recent_;
  Session session_;
  Autosave autosave_;
  FilmRecorder film_recorder_;
  Forecaster forecaster_;
  std::string reported_difference_;
  std::filesystem::path recording_;  // the file of it; empty: none
  FileWatch watch_;
  double watched_at_ = 0.0;  // [s]
  SystemDialog system_dialog_;
  bool has_system_dialog_ = false;
  std::vector<RecoverableScene> recoverable_;
  std::vector<RecoveryEntry> recovery_entries_;  // the same for the panels

  std::filesystem::path file_;                   // of the document; empty: it has none
  std::filesystem::path saving_to_;              // what waits for the answer about a file that others changed
  std::optional<Request> pending_;               // what waits for the answer about unsaved changes
  std::shared_ptr<const Scene> scene_to_frame_;  // a document whose camera waits for the window's size
  bool finished_ = false;
  std::chrono::milliseconds work_patience_{80};
  // last: they are waited for before anything that they use is gone
  std::future<std::string> export_run_;
  BackgroundTask work_;
};

}  // namespace hooke
