// What each action and each request of the panels does.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/app.h"
#include "app/document/files.h"
#include "base/errors.h"
#include "base/overloaded.h"
#include "base/printable.h"
#include "draw/camera_text.h"
#include "edit/copy_selection.h"
#include "formats/scene_file.h"

namespace hooke {

void App::perform(Action action, bool repeated) {
  switch (action) {
    case Action::SelectTool:
    case Action::AddTool:
    case Action::AttachTool:
    case Action::NailTool:
    case Action::DragTool:
    case Action::CutTool:
    case Action::DeleteTool:
      return take_tool(action);

    case Action::RunOrPause:
      return lab_.submit(SetRunning{!status().run.running});
    case Action::StepOnce:
      return lab_.submit(StepOnce{});
    case Action::StepBack:
      return lab_.submit(StepBack{});
    case Action::Slower:
      return tune(tune_speed(status(), 0.5), repeated);
    case Action::Faster:
      return tune(tune_speed(status(), 2.0), repeated);
    case Action::GoToStart:
      return lab_.submit(GoToStart{});
    case Action::ReleaseNails:
      return release_nails();

    case Action::StiffnessUp:
      return tune(tune_stiffness(status(), selection_, +1), repeated);
    case Action::StiffnessDown:
      return tune(tune_stiffness(status(), selection_, -1), repeated);
    case Action::SubstepsUp:
      return tune(tune_substeps(status(), +1), repeated);
    case Action::SubstepsDown:
      return tune(tune_substeps(status(), -1), repeated);

    case Action::Undo:
      return lab_.submit(Undo{});
    case Action::Redo:
      return lab_.submit(Redo{});
    case Action::SelectAll:
      selection_ = select_all(tool_context_.system());
      return;
    case Action::SelectInverted:
      selection_ = invert_selection(tool_context_.system(), selection_);
      return;
    case Action::SelectConnected:
      selection_ = select_connected(tool_context_.system(), selection_);
      return;
    case Action::Duplicate:
      return duplicate();
    case Action::Cut:
      return copy(AfterCopy::Delete);
    case Action::Copy:
      return copy();
    case Action::Paste:
      return paste();
    case Action::DeleteSelection:
      return delete_selection();
    case Action::Cancel:
      return cancel();

    case Action::FrameAll:
      return frame_scene(tool_context_.camera, tool_context_.system(), tool_context_.snapshot().state,
                         tool_context_.size.x / tool_context_.size.y);
    case Action::ShowPlots:
      panels_.plots_shown = !panels_.plots_shown;
      if (panels_.plots_shown &&
          lay_out(layout_.menu.width, layout_.status.y + layout_.status.height, tool_context_.scale, {.plots = true}).plots.height == 0.0)
        panels_.show_toast("The window is too low for plots");
      if (panels_.plots_shown && status().timeline.traces->traces.empty()) lab_.submit(Watch{first_plots(tool_context_.system())});
      return;
    case Action::HidePanels:
      panels_.panels_hidden = !panels_.panels_hidden;
      return;
    case Action::LightOrDark:
      preferences_.light = panels_.look == Look::Dark;
      panels_.look = preferences_.light ? Look::Light : Look::Dark;
      keep_preferences();
      return;
    case Action::FrameSelection:
      return frame_selection();
    case Action::ViewFront:
      return look_from(tool_context_.camera.front());
    case Action::ViewSide:
      return look_from(glm::cross(tool_context_.camera.pole, tool_context_.camera.front()));
    case Action::ViewTop:
      return look_from(tool_context_.camera.pole);
    case Action::Orthographic:
      tool_context_.camera.orthographic = !tool_context_.camera.orthographic;
      return panels_.show_toast(tool_context_.camera.orthographic ? "Orthographic" : "Perspective");
    case Action::FollowScene:
      tool_context_.camera.follows = !tool_context_.camera.follows;
      return panels_.show_toast(tool_context_.camera.follows ? "Following what moves" : "Not following");
    case Action::CopyCamera:
      return copy_camera();
    case Action::PasteCamera:
      return paste_camera();
    case Action::LargerPanels:
      return scale_panels(1.15);
    case Action::SmallerPanels:
      return scale_panels(1.0 / 1.15);
    case Action::SearchCommands:
      panels_.gallery.is_shown = false;  // what is found acts on the scene
      panels_.search = {.shown = true, .is_new = true};
      return;
    case Action::ShowKeys:
      panels_.keys_shown = !panels_.keys_shown;
      return;

    case Action::ShowGallery:
      panels_.gallery.is_shown = !panels_.gallery.is_shown;
      return;

    case Action::NewScene:
      return confirm_unsaved_then(action);
    case Action::OpenScene:
      if (preferences_.system_dialogs && has_system_dialog_) return open_system_dialog(false);
      return panels_.open_file_dialog(Dialog::Kind::Open, start_folder());
    case Action::Save:
      return save();
    case Action::SaveAs:
      return open_path_dialog();
    case Action::Export:
      return open_export_dialog();
    case Action::TakePicture:
      picture_file_ = name_for(".png");
      return;
    case Action::FilmOnOff:
      return film();
    case Action::RecordOnOff:
      return record();
    case Action::Quit:
      return confirm_unsaved_then(action);
  }
}

void App::handle(const Request& request) {
  std::visit(Overloaded{
                 [this](const Edit& edit) {
                   if (!edit.continues) ++last_gesture_;
                   lab_.submit(edit.command, last_gesture_);
                 },
                 [this](const Scrub& scrub) {
                   if (!scrub.continues) ++last_gesture_;
                   lab_.submit(GoToTime{scrub.time}, last_gesture_);
                 },
                 [this](const Control& control) { lab_.submit(control); },
                 [this](Action action) { perform(action); },
                 [this](const OpenFile& open_file) { confirm_unsaved_then(OpenFile{typed_path(open_file.file)}); },
                 [this](const SaveFile& save_file) { save_to(typed_path(save_file.file)); },
                 [this](const ChooseTexture& choose) { choose_texture(choose.texture); },
                 [this](const LookFrom& look) { look_from(look.direction); },
                 [this](const OpenSystemDialog& open_dialog) { open_system_dialog(open_dialog.to_save); },
                 [this](const Recover& wanted) { recover(wanted.which); },
                 [this](const DiscardRecovery& unwanted) { discard_recovery(unwanted.which); },
                 [this](Answer given) { answer(given); },
             },
             request);
}

void App::tune(const Tuning& tuning, bool repeated) {
  if (!repeated) ++last_gesture_;
  for (const Command& command : tuning.commands) lab_.submit(command, last_gesture_);
  panels_.show_toast(tuning.message);
}

// The nearest thing to leave: a menu, the keys, what the tool has half done, the selection, the tool.
void App::cancel() {
  panels_.toast.clear();
  if (panels_.menu_is_open) {
    panels_.menu_closes = true;
    return;
  }
  if (std::exchange(panels_.keys_shown, false) || std::exchange(panels_.search.shown, false) ||
      std::exchange(panels_.gallery.is_shown, false))
    return;
  tool_is_pressed_ = false;
  if (tool_->cancel(tool_context_)) return;
  if (!selection_.empty())
    selection_ = {};
  else
    take_tool(Action::SelectTool);
}

// Enter and Esc, unless a number is being typed.
bool App::handle_placement_key(const KeyPress& press) {
  if (!panels_.placement.is_on() || panels_.menu_is_open || panels_.typing != 0 || panels_.placement.types_path) return false;
  if (press.key == Key::Enter) panels_.placement.wants_place = true;
  if (press.key == Key::Escape) panels_.placement.stop();
  return press.key == Key::Enter || press.key == Key::Escape;
}

// What the panel and the mouse want of what is being placed.
void App::update_placement() {
  Placement& placement = panels_.placement;
  if (!placement.is_on()) {
    mesh_.reset();
    moves_placement_ = false;
    return;
  }
  if (std::exchange(placement.is_new, false)) {
    placement.shape.at = tool_context_.camera.target;
    mesh_.reset();
  }
  if (moves_placement_) placement.shape.at = tool_context_.point_in_view_plane(pointer().at, placement.shape.at);
  if (tool_context_.system().dimensions == 2) placement.shape.at.z = 0.0;
  if (std::exchange(placement.wants_mesh, false)) read_mesh(typed_path(placement.mesh_path));
  if (std::exchange(placement.wants_place, false)) place();
}

void App::read_mesh(const std::filesystem::path& file) {
  begin_work("Reading " + printable(file.filename().native(), 60), [this, file](const Progress& progress) -> BackgroundTask::Completion {
    return [this, loaded = load_mesh_part(file, progress)] {
      if (work_.was_stopped()) return panels_.show_toast("Stopped: no mesh was read");
      if (!loaded.scene) panels_.show_message("Cannot use the mesh", loaded.error);
      mesh_ = loaded.scene;
      panels_.placement.mesh_info = mesh_ ? std::to_string(mesh_->system.point_count()) + " points" : "";
    };
  });
}

void App::place() {
  const Scene part = part_of(panels_.placement, mesh_.get(), tool_context_.camera.pole, tool_context_.system().dimensions == 2);
  if (part.system.point_count() == 0) return panels_.show_toast("Nothing to place yet");
  lab_.submit(make_insert(part, Vec3(0.0), {[this] { return lab_.new_point_id(); }, [this] { return lab_.new_spring_id(); }}));
  panels_.placement.stop();
}

void App::delete_selection() {
  if (selection_.empty()) return;
  lab_.submit(Remove{selection_.points, selection_.springs});
  selection_ = {};
}

// As the whole scene is framed, with the selected points alone.
void App::frame_selection() {
  const Scene part = copy_selection(tool_context_.snapshot(), tool_context_.status->document->sheet, selection_);
  if (part.system.points().empty()) return panels_.show_toast("Nothing is selected");
  frame_scene(tool_context_.camera, part.system, part.state, tool_context_.size.x / tool_context_.size.y);
}

// From there; from the other side when it is seen from there already.
void App::look_from(const Vec3& direction) {
  Camera& camera = tool_context_.camera;
  if (tool_context_.system().dimensions == 2) return panels_.show_toast("A flat scene is seen from the front");
  const bool is_there = glm::dot(camera.back, glm::normalize(direction)) > 1.0 - 1e-9;
  camera.look_from(is_there ? -direction : direction);
}

// As `hooke capture --camera` takes it.
void App::copy_camera() {
  const std::string text = camera_text(pose_of(tool_context_.camera));
  clipboard_.put(text);
  panels_.show_toast("Copied the camera: " + text);
}

void App::paste_camera() {
  const auto pose = camera_from_text(clipboard_.take());
  if (!pose) return panels_.show_toast("The clipboard holds no camera");
  ViewSettings view;
  view.camera = pose;
  view.camera->follows = tool_context_.camera.follows;
  const Camera pasted =
      make_camera(view, tool_context_.system(), tool_context_.snapshot().state, tool_context_.size.x / tool_context_.size.y);
  if (tool_context_.system().dimensions == 2 && pasted.back != tool_context_.camera.back)
    return panels_.show_toast("A flat scene is seen from the front");
  tool_context_.camera = pasted;
  panels_.show_toast("Pasted the camera");
}

void App::release_nails() {
  SetNailed release;
  for (const Point& point : tool_context_.system().points())
    if (point.nailed) release.items.push_back({point.id, false});
  if (!release.items.empty()) lab_.submit(release);
}

// Larger or smaller by a step, from then on in every run.
void App::scale_panels(double factor) {
  const PreferenceRow& row = preference_rows()[0];
  preferences_.interface_scale = std::clamp(std::round(20.0 * factor * preferences_.interface_scale) / 20.0, row.min, row.max);
  panels_.show_toast("Panels at " + std::to_string(std::lround(100.0 * preferences_.interface_scale)) + " %");
  keep_preferences();
}

void App::keep_preferences() {
  try {
    save_preferences(preferences_, home_.config);
  } catch (const FileError& error) {
    panels_.show_toast(error.what());
  }
}

}  // namespace hooke
