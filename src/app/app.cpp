#include "app/app.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/document/files.h"
#include "formats/scene_file.h"
#include "scene/parameters.h"

namespace hooke {
namespace {

// How long an event may wait for the one before it to take effect.
constexpr auto patience = std::chrono::milliseconds(50);

constexpr double zoom_per_step = 0.88;
constexpr double turn_per_height = 3.14159265358979323846;  // [rad], for a drag over the height of the scene

// The page hides the scene, which nothing may happen to unseen.
bool is_allowed_in_gallery(const Shortcut& shortcut) {
  return shortcut.group == "File" || shortcut.action == Action::Cancel || shortcut.action == Action::ShowGallery ||
         shortcut.action == Action::ShowKeys || shortcut.action == Action::SearchCommands;
}

}  // namespace

App::App(std::shared_ptr<const Scene> scene, std::filesystem::path file, const Home& home)
    : lab_(*scene),
      tool_context_{lab_, selection_, last_gesture_, lab_.status(), {}},
      home_(home),
      recent_(home.state),
      session_(home.state.empty() ? home.state : home.state / "runs"),
      autosave_(session_),
      has_system_dialog_(!SystemDialog::find().empty()),
      file_(std::move(file)),
      scene_to_frame_(std::move(scene)) {
  LoadedPreferences loaded = load_preferences(home.config);
  preferences_ = loaded.preferences;
  autosave_.set_interval(preferences_.autosave_seconds);
  panels_.look = preferences_.light ? Look::Light : Look::Dark;
  if (!loaded.message.empty()) panels_.queue_message("The settings were set aside", std::move(loaded.message));
  list_recoverable();
  if (!recoverable_.empty()) panels_.waiting.push_back({.kind = Dialog::Kind::Recovery, .is_new = true});
  // a clipboard of our own until the window lends its
  clipboard_ = {.put = [this](const std::string& text) { own_clipboard_ = text; }, .take = [this] { return own_clipboard_; }};
  take_tool(Action::SelectTool);
  take_switches(tool_context_.status->document->view);
  begin_document();
}

void App::resize(const glm::dvec2& size, double scale) {
  layout_ = lay_out(size.x, size.y, scale, {.panels = !panels_.panels_hidden, .plots = panels_.plots_shown});
  tool_context_.size = {layout_.scene.width, layout_.scene.height};
  tool_context_.scale = scale;
  if (const auto scene = std::exchange(scene_to_frame_, nullptr))
    tool_context_.camera = make_camera(scene->view, scene->system, scene->state, tool_context_.size.x / tool_context_.size.y);
}

void App::handle(const Event& event) {
  std::visit([this](const auto& what) { on(what); }, event);
}

Pointer App::pointer() const { return {cursor_ - glm::dvec2(layout_.scene.x, layout_.scene.y), modifiers_}; }

void App::take_status() {
  const auto before = std::exchange(tool_context_.status, lab_.status());
  tool_context_.shows_surface = panels_.view.surface;
  if (before->snapshot->system != tool_context_.status->snapshot->system) selection_ = existing_part_of(tool_context_.system(), selection_);
}

void App::settle() {
  lab_.settle(patience);
  take_status();
}

void App::on(const KeyPress& press) {
  if (panels_.dialog.kind != Dialog::Kind::None) {
    panels_.dialog.accepted = panels_.dialog.accepted || press.key == Key::Enter;
    panels_.dialog.cancelled = panels_.dialog.cancelled || press.key == Key::Escape;
    return;
  }
  if (panels_.search.shown && search(press)) return;
  if (handle_export_key(press) || handle_placement_key(press)) return;
  // a field that is typed into is left by these, and nothing else
  if (panels_.text_in_progress && press.key != Key::F1 && !press.modifiers.control) return;
  if (panels_.gallery.is_shown && !panels_.menu_is_open && press.modifiers == Modifiers{}) {
    if (move_in_gallery(panels_, layout_, press.key)) return;
    if (press.key == Key::Enter) return confirm_unsaved_then(OpenFile{shipped_scenes()[panels_.gallery.chosen].file});
  }
  const Shortcut* shortcut = find_shortcut(press.key, press.modifiers);
  if (shortcut == nullptr || (press.repeated && !shortcut->repeats)) return;
  if (panels_.gallery.is_shown && !is_allowed_in_gallery(*shortcut)) return;
  settle();
  perform(shortcut->action, press.repeated);
}

// Whether the key is the search's.
bool App::search(const KeyPress& press) {
  Search& search = panels_.search;
  switch (press.key) {
    case Key::Enter:
      search.accepted = true;
      return true;
    case Key::Up:
    case Key::Down:
      search.highlighted += press.key == Key::Up ? -1 : 1;
      return true;
    case Key::Escape:
      search.shown = false;
      return true;
    default:
      return true;
  }
}

void App::on(const ButtonPress& press) {
  cursor_ = press.at;
  modifiers_ = press.modifiers;
  if (panels_cover(panels_, layout_, press.at.x, press.at.y)) return;
  settle();
  if (press.button != Button::Left) {
    turning_with_ = press.button;
  } else if (panels_.placement.is_on()) {
    moves_placement_ = true;
  } else if (!tool_is_pressed_) {
    tool_is_pressed_ = true;
    Pointer pressed = pointer();
    pressed.twice = press.twice;
    tool_->press(pressed, tool_context_);
  }
}

void App::on(const ButtonRelease& release) {
  cursor_ = release.at;
  modifiers_ = release.modifiers;
  if (turning_with_ == release.button) turning_with_.reset();
  if (release.button == Button::Left) moves_placement_ = false;
  if (release.button != Button::Left || !std::exchange(tool_is_pressed_, false)) return;
  settle();
  tool_->release(pointer(), tool_context_);
}

void App::on(const CursorMove& move) {
  const glm::dvec2 from = pointer().at;
  cursor_ = move.at;
  modifiers_ = move.modifiers;
  if (!turning_with_) return;
  // a flat scene is always seen from the front
  const bool pan = tool_context_.system().dimensions == 2 || (*turning_with_ == Button::Middle && move.modifiers.shift);
  const glm::dvec2 displacement = pointer().at - from;
  if (pan)
    tool_context_.camera.pan(from, pointer().at, tool_context_.size);
  else
    tool_context_.camera.orbit(-displacement.x * turn_per_height / tool_context_.size.y,
                               displacement.y * turn_per_height / tool_context_.size.y);
}

void App::on(const Scroll& scroll) {
  if (!panels_cover(panels_, layout_, scroll.at.x, scroll.at.y))
    tool_context_.camera.zoom(std::pow(zoom_per_step, scroll.steps), pointer().at, tool_context_.size);
}

void App::on(const FileDrop& drop) {
  // a box that asks something has the word
  if (panels_.dialog.kind != Dialog::Kind::None) return panels_.show_toast("Close this box first");
  if (drop.file.extension() == ".png")
    choose_texture(drop.file.string());
  else
    confirm_unsaved_then(OpenFile{drop.file});
}
void App::on(const CloseRequest&) {
  if (work_.is_running()) work_.stop();
  wait_for_work();
  perform(Action::Quit);
}

void App::take_tool(Action action) {
  if (tool_) tool_->cancel(tool_context_);
  tool_is_pressed_ = false;
  const auto rows = tools();
  tool_ = std::ranges::find(rows, action, &ToolRow::action)->make();
  tool_action_ = action;
}

void App::build_frame(const FrameStatistics& frame_statistics) {
  poll_background_work();
  forecaster_.follow(status());
  if (tool_is_pressed_)
    tool_->follow(pointer(), tool_context_);
  else
    follow_scene(tool_context_.camera, tool_context_.snapshot().state);

  Requests requests;
  const auto band = tool_->rubber_band();
  std::optional<Rect> rubber_band;
  if (band) {
    const glm::dvec2 min = glm::min(band->first, band->second), max = glm::max(band->first, band->second);
    rubber_band = Rect{layout_.scene.x + min.x, layout_.scene.y + min.y, max.x - min.x, max.y - min.y};
  }
  const PanelInput input{.status = *tool_context_.status,
                         .selection = selection_,
                         .layout = layout_,
                         .tools = tool_buttons(),
                         .tool = tool_action_,
                         .next_step = tool_->next_step(tool_context_),
                         .file = file_,
                         .frames_per_second = frame_statistics.frames_per_second,
                         .draw_ms = frame_statistics.draw_ms,
                         .film_seconds = film_recorder_.is_filming() ? film_recorder_.seconds() : -1.0,
                         .rubber_band = rubber_band,
                         .stroke = tool_->stroke(),
                         .recent = recent_.files(),
                         .left = recovery_entries_,
                         .has_desktop_dialog = has_system_dialog_,
                         .camera = tool_context_.camera,
                         .forecast = &forecaster_.newest()};
  build_panels(input, panels_, requests);
  for (const Request& request : requests) handle(request);
  update_placement();
  update_export();

  marks_ = {.selected_points = selection_.points, .selected_springs = selection_.springs};
  if (panels_.placement.is_on())
    return mark_part(part_of(panels_.placement, mesh_.get(), tool_context_.camera.pole, tool_context_.system().dimensions == 2), marks_);
  const bool over_scene = !panels_cover(panels_, layout_, cursor_.x, cursor_.y);
  if ((over_scene || tool_is_pressed_) && !turning_with_) tool_->mark(pointer(), tool_context_, marks_);

  // what broke is lit up until something else is pointed at
  if (const auto& divergence = tool_context_.snapshot().divergence; divergence && !marks_.hovered_point && !marks_.hovered_spring) {
    marks_.hovered_point = divergence->point;
    marks_.hovered_spring = divergence->spring;
  }
}

// What a document asks to be shown; from then on it is the person's.
void App::take_switches(const ViewSettings& view) {
  panels_.view.surface = view.surface;
  panels_.view.springs = view.springs;
  panels_.view.points = view.points;
  panels_.view.strain_colors = view.strain_colors;
  panels_.view.shadows = view.shadows;
}

ViewOptions App::view_options() const {
  ViewOptions options = panels_.view;
  options.cloth_texture = status().document->cloth_texture;
  options.background = background_of(panels_.look);
  if (status().document->view.background) options.background = *status().document->view.background;
  return options;
}

std::string App::title() const {
  const std::string& name = status().document->name;
  const std::string shown = !file_.empty() && !is_shipped(file_) ? file_.stem().string() : name.empty() ? "Untitled" : name;
  return "Hooke - " + shown + (status().history.unsaved ? "*" : "");
}

bool App::is_idle() const {
  return !work_.is_running() && !panels_.export_state.is_running() && !picture_file_ && !film_recorder_.is_filming() &&
         !film_recorder_.is_writing() && !status().run.running && panels_.toast.empty() && !tool_is_pressed_ && !turning_with_;
}

}  // namespace hooke
