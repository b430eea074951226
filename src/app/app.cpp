#include "app/app.h"

#include <algorithm>
#include <utility>

#include "base/overloaded.h"
#include "edit/history_list.h"
#include "ui/strain_legend.h"
#include "ui/text.h"

namespace hooke {
namespace {

// "Undo: nail 3 points"; empty: neither undone nor redone.
std::string history_move(const HistoryList& from, const HistoryList& to) {
  if (from.done == to.done || from.recorded != to.recorded || from.names != to.names) return {};
  const auto [first, last] = std::minmax(from.done, to.done);
  return (to.done < from.done ? "Undo: " : "Redo: ") +
         (last - first == 1 ? to.names[first] : count(static_cast<long>(last - first), "step"));
}

}  // namespace

App::App(std::shared_ptr<const Scene> scene, std::filesystem::path file, const Home& home)
    : lab_(*scene),
      tool_context_{lab_, lab_.status(), {}},
      clipboard_{.put = [this](const std::string& text) { clipboard_.own = text; }, .take = [this] { return clipboard_.own; }},
      settings_(home, panels_),
      file_task_(panels_),
      tool_(tool_context_),
      camera_control_(tool_context_, panels_, clipboard_, std::move(scene)),
      placer_(tool_context_, panels_, file_task_),
      mouse_(tool_context_, panels_, tool_, camera_control_, placer_),
      document_(tool_context_, panels_, file_task_, settings_, home, std::move(file), [this](const Scene& opened) { show(opened); }),
      captures_(tool_context_, panels_, document_),
      exporter_(tool_context_, panels_, file_task_, captures_, document_),
      selection_editor_(tool_context_, panels_, file_task_, clipboard_),
      keyboard_{make_key_handlers()} {
  take_switches(status().document->view);
  if (!settings_.values().measure_accuracy) lab_.submit(SetAccuracy{AccuracyMode::Off});
}

void App::resize(const glm::dvec2& size, double scale) {
  tool_context_.layout = lay_out(size.x, size.y, scale,
                                 {.panels = panels_.shown.panels,
                                  .plots = panels_.plots.is_shown || panels_.plots.table.is_shown,
                                  .strain_legend = shows_strain_colors(tool_context_.system(), panels_.view)});
  tool_context_.size = {tool_context_.layout.scene.width, tool_context_.layout.scene.height};
  tool_context_.scale = scale;
  camera_control_.show_first();
}

void App::handle(const Event& event) {
  std::visit(Overloaded{
                 [this](const KeyPress& press) { dispatch(keyboard_.handlers, press); },
                 [this](const FileDrop& dropped) { drop(dropped); },
                 [this](const CloseRequest&) {
                   if (file_task_.is_running()) file_task_.stop();
                   perform(Action::Quit);
                 },
                 [this](const auto& of_mouse) { mouse_.handle(of_mouse); },
             },
             event);
}

void App::drop(const FileDrop& dropped) {
  // modal dialogs take precedence
  if (panels_.dialog.kind != Dialog::Kind::None) return panels_.show_toast("Close this dialog first");
  if (dropped.file.extension() == ".png")
    choose_texture(dropped.file.string());
  else
    document_.open(dropped.file);
}

void App::build_frame(const FrameStatistics& frame_statistics) {
  poll_background_work();
  work_.follow(status(), panels_, lab_);
  const auto before = std::exchange(shown_, tool_context_.status);
  if (before && status().run.gas_releases > before->run.gas_releases) panels_.show_toast("A tear released the gas of a surface");
  const std::string& refusal = status().run.device_refusal;
  if (!refusal.empty() && !(before && refusal == before->run.device_refusal)) panels_.show_toast("Computed on the CPU: " + refusal);
  if (const std::string notice = std::exchange(tool_context_.notice, {}); !notice.empty()) panels_.show_toast(notice);
  if (before && before->history.list != status().history.list)
    if (const std::string moved = history_move(*before->history.list, *status().history.list); !moved.empty()) panels_.show_toast(moved);
  if (tool_.is_pressed())
    tool_.follow(mouse_.pointer());
  else
    camera_control_.follow();

  Requests requests;
  build_panels(panel_input(frame_statistics), panels_, requests);
  keyboard_.for_panels.clear();
  for (const Request& request : requests) handle(request);
  tool_context_.shows_surface = panels_.view.surface;

  follow_plots();
  placer_.follow(mouse_.pointer());
  exporter_.poll();
  update_marks();
}

void App::poll_background_work() {
  tool_context_.take_status();
  captures_.poll();
  file_task_.update();
  document_.poll();
}

PanelInput App::panel_input(const FrameStatistics& frame_statistics) const {
  return {.status = status(),
          .selection = tool_context_.selection,
          .layout = tool_context_.layout,
          .tool = {tool_buttons(), tool_.action(), tool_.next_step(), tool_.rubber_band(tool_context_.layout.scene), tool_.stroke()},
          .file = document_.file(),
          .folder = panels_.placement.is_mesh ? document_.start_folder() : std::filesystem::path(),
          .frames_per_second = frame_statistics.frames_per_second,
          .draw_ms = frame_statistics.draw_ms,
          .waiting_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - tool_context_.frame_seen).count(),
          .film_seconds = captures_.film_seconds(),
          .recent = document_.recent_files(),
          .recovered = document_.recovery_entries(),
          .keys = keyboard_.for_panels,
          .work = file_task_.progress(),
          .export_work = exporter_.progress(),
          .has_desktop_dialog = document_.has_system_dialog(),
          .camera = tool_context_.camera,
          .results = work_.results(),
          .marks = &marks_};
}

void App::update_marks() {
  marks_ = {.selected_points = tool_context_.selection.points, .selected_springs = tool_context_.selection.springs};
  const auto& ghosts = status().companions.list;
  for (std::size_t i = 0; i < ghosts.size(); ++i)
    if (ghosts[i].positions) marks_.ghost_networks.push_back({ghosts[i].positions, to_color(ghost_color(i))});
  marks_.crossed = work_.crossings.found();
  marks_.arrows = make_arrows(*status().snapshot, panels_.view, tool_context_.view_height(), work_.force_arrows);
  placer_.mark(marks_);
  if (placer_.is_on()) return;
  if ((mouse_.is_over_scene() || tool_.is_pressed()) && !camera_control_.is_dragging()) tool_.mark(mouse_.pointer(), marks_);

  if (const auto& divergence = tool_context_.snapshot().divergence) {
    marks_.failed_point = divergence->point;
    marks_.failed_spring = divergence->spring;
  }
}

// What the laboratory measures for the plots is what the document plots.
void App::follow_plots() {
  if (!panels_.plots.is_shown) return;
  const auto& traces = status().timeline.traces->traces;
  std::vector<Quantity> wanted = plotted(*status().document, tool_context_.system());
  const auto is_same = [](const Trace& trace, const Quantity& quantity) { return trace.quantity.name() == quantity.name(); };
  if (!std::ranges::equal(traces, wanted, is_same)) lab_.submit(Watch{std::move(wanted)});
}

// Another scene is about to replace the one on screen.
void App::show(const Scene& scene) {
  tool_.reset();
  tool_context_.selection = {};
  panels_.gallery.is_shown = false;
  panels_.side.to_top = true;
  placer_.stop();
  camera_control_.show(scene);
  take_switches(scene.view);
  panels_.ghosts = {};
  panels_.side.lesson_steps_done = 0;
  work_.clear(status(), lab_);
}

// Applies the view settings of the scene; the user may change them afterwards.
void App::take_switches(const ViewSettings& view) {
  copy_visible_parts(view, panels_.view);
  panels_.plots.is_shown = panels_.plots.is_shown || !view.plots.empty();
  tool_context_.shows_surface = view.surface;
}

ViewOptions App::view_options() const {
  ViewOptions options = panels_.view;
  options.cloth_texture = status().document->cloth_texture;
  options.background = background_of(panels_.look);
  if (status().document->view.background) options.background = *status().document->view.background;
  return options;
}

bool App::is_idle() const {
  return !file_task_.is_running() && !exporter_.is_running() && !captures_.is_busy() && !work_.is_running() && !status().run.running &&
         panels_.messages.toast.empty() && !tool_.is_pressed() && !camera_control_.is_dragging() && !camera_control_.is_flying();
}

void App::finish() {
  captures_.end();
  settle();
  document_.end();
  finished_ = true;
}

}  // namespace hooke
