// The window program without the window: it receives events, builds the panels, and provides what to draw. App only composes the parts that
// do the work and routes events and requests to them.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/document/document.h"
#include "app/edit/clipboard.h"
#include "app/edit/placer.h"
#include "app/edit/selection_editor.h"
#include "app/input/key_handlers.h"
#include "app/input/mouse_input.h"
#include "app/media/captures.h"
#include "app/media/exporter.h"
#include "app/tools/active_tool.h"
#include "app/tools/tune.h"
#include "app/view/camera_control.h"
#include "app/window/event.h"
#include "app/work/background_work.h"
#include "app/work/file_task.h"
#include "ui/panels.h"

namespace hooke {

// Measured by the main loop.
struct FrameStatistics {
  double frames_per_second = 0.0, draw_ms = 0.0;
};

class App {
 public:
  // `file`: of the scene; empty if it has none. Without a home nothing is saved between runs.
  App(std::shared_ptr<const Scene> scene, std::filesystem::path file, const Home& home = {});

  // The size of the window and its content scale. The first call frames the scene.
  void resize(const glm::dvec2& size, double scale);
  void handle(const Event& event);
  void handle(const Request& request);
  // Once per frame, between ImGui::NewFrame and ImGui::Render.
  void build_frame(const FrameStatistics& frame_statistics);
  // The part of a frame that is also needed while the window is hidden.
  void poll_background_work();

  // For drawing the scene.
  const Status& status() const { return *tool_context_.status; }
  const Camera& camera() const { return tool_context_.camera; }
  const Layout& layout() const { return tool_context_.layout; }
  const Marks& marks() const { return marks_; }
  ViewOptions view_options() const;
  // What the panels show.
  PanelInput panel_input(const FrameStatistics& frame_statistics) const;
  std::string title() const { return document_.title(); }
  double interface_scale() const { return settings_.values().interface_scale; }
  // Nothing moves, so the loop may wait for the next event.
  bool is_idle() const;
  bool is_finished() const { return finished_; }

  Panels& panels() { return panels_; }
  Document& document() { return document_; }
  Captures& captures() { return captures_; }
  const Exporter& exporter() const { return exporter_; }
  const Selection& selection() const { return tool_context_.selection; }
  Action tool() const { return tool_.action(); }
  // Key handlers, in the order of precedence.
  const KeyHandlers& key_handlers() const { return keyboard_.handlers; }

  // Until the window provides one, copies stay within the program.
  void use(Clipboard clipboard) { clipboard_ = std::move(clipboard); }
  // The maximum time that an event waits for the previous one to take effect, and a file operation before it shows its progress.
  void set_event_patience(std::chrono::milliseconds patience) { tool_context_.patience = patience; }
  void set_task_patience(std::chrono::milliseconds patience) { file_task_.set_patience(patience); }
  // Waits until the laboratory has handled everything submitted. Returns false if that takes longer than the patience of an event.
  bool settle() { return tool_context_.settle(); }
  void wait_for_file_task() { file_task_.wait(); }

 private:
  KeyHandlers make_key_handlers();
  bool press_in_gallery(const KeyPress& press);
  bool perform_shortcut(const KeyPress& press);
  void drop(const FileDrop& dropped);
  void perform(Action action, bool repeated = false);
  void tune(const Tuning& tuning, TunedBy keys, bool repeated);
  void start_placement(const StartPlacement& start);
  void set_start();
  void compare_methods();
  void check_result();
  void show_ghosts(bool with_reference);
  void save_comparison(const std::string& extension);
  void show_failure();
  void cancel();
  void open_search();
  void show_or_hide_plots();
  void show_or_hide_table();
  void follow_plots();
  void show_or_hide_at_left(bool* panel);
  void choose_texture(const std::string& typed);
  void release_nails();
  void switch_muscles();
  void switch_device();
  void show(const Scene& scene);
  void take_switches(const ViewSettings& view);
  void update_marks();
  void finish();

  LabThread lab_;
  std::shared_ptr<const Status> shown_;  // in the last frame
  ToolContext tool_context_;
  Panels panels_;
  Marks marks_;
  Clipboard clipboard_;

  UserSettings settings_;
  FileTask file_task_;
  ActiveTool tool_;
  CameraControl camera_control_;
  Placer placer_;
  MouseInput mouse_;
  BackgroundWork work_;
  Document document_;
  Captures captures_;
  Exporter exporter_;
  SelectionEditor selection_editor_;
  Keyboard keyboard_;
  bool finished_ = false;
};

}  // namespace hooke
