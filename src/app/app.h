// The program of the window, without the window: events and frames in, commands out, and what there is to draw.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/event.h"
#include "app/tools.h"
#include "app/tune.h"
#include "ui/panels.h"

namespace hooke {

// Measured by the window's loop.
struct Figures {
  double frames_per_second = 0.0, draw_ms = 0.0;
};

class App {
 public:
  // `file`: where the scene came from; empty: from nowhere.
  App(std::shared_ptr<const Scene> scene, std::filesystem::path file);

  // The window's size and its content scale. The first call frames the scene.
  void resize(const glm::dvec2& size, double scale);
  void handle(const Event& event);
  // Once a frame, between ImGui::NewFrame and ImGui::Render: the tool follows the cursor, the panels are built and obeyed.
  void build_frame(const Figures& figures);

  const Status& status() const { return *bench_.status; }
  const Camera& camera() const { return bench_.camera; }
  const Layout& layout() const { return layout_; }
  ViewOptions view_options() const;
  const Marks& marks() const { return marks_; }
  std::string title() const;
  bool is_finished() const { return finished_; }
  // Nothing moves by itself: the loop may wait for the next event.
  bool is_still() const;

  Panels& panels() { return panels_; }
  const Selection& selection() const { return selection_; }
  Action tool() const { return tool_action_; }
  // Waits until what was asked of the laboratory is done, and takes its newest status.
  void settle();

 private:
  void on(const KeyPress& press);
  void on(const ButtonPress& press);
  void on(const ButtonRelease& release);
  void on(const CursorMove& move);
  void on(const Scroll& scroll);
  void on(const FileDrop& drop);
  void on(const CloseRequest&);

  void perform(Action action, bool repeated = false);
  void obey(const Request& request);
  void tune(const Tuning& tuning, bool repeated);
  void take_tool(Action action);
  void cancel();
  void delete_selection();
  void release_nails();

  // Does it now, or after the person was asked about unsaved changes.
  void unless_unsaved(Request request);
  void take_document(std::shared_ptr<const Scene> scene, std::filesystem::path file);
  void open(const std::filesystem::path& file);
  bool save_to(const std::filesystem::path& file);
  void save();
  void ask_for_path();
  void choose_texture(const std::string& typed);
  void answer(Answer answer);
  void go_on_after_saving();

  void take_status();
  void take_switches(const ViewSettings& view);
  Pointer pointer() const;

  LabThread lab_;
  Selection selection_;
  Gesture last_gesture_ = 0;
  Workbench bench_;

  std::unique_ptr<Tool> tool_;
  Action tool_action_ = Action::SelectTool;
  std::vector<ToolButton> tool_buttons_;
  bool tool_is_pressed_ = false;
  std::optional<Button> turning_with_;  // the button that moves the camera
  glm::dvec2 cursor_{0.0};              // in window coordinates
  Modifiers modifiers_;

  Panels panels_;
  Layout layout_;
  Marks marks_;
  std::filesystem::path file_;             // of the document; empty: it has none
  std::optional<Request> pending_;         // what waits for the answer about unsaved changes
  std::shared_ptr<const Scene> to_frame_;  // a document whose camera waits for the window's size
  bool finished_ = false;
};

}  // namespace hooke
