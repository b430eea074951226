// What each action and each request of the panels does.
#include "app/app.h"
#include "app/files.h"
#include "lab/scene_file.h"
#include "sim/overloaded.h"

namespace hooke {

void App::perform(Action action, bool repeated) {
  switch (action) {
    case Action::SelectTool:
    case Action::AddTool:
    case Action::AttachTool:
    case Action::NailTool:
    case Action::DragTool:
    case Action::DeleteTool:
      return take_tool(action);

    case Action::RunOrPause:
      return lab_.submit(SetRunning{!status().running});
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
      selection_ = everything(bench_.system());
      return;
    case Action::DeleteSelection:
      return delete_selection();
    case Action::Cancel:
      return cancel();

    case Action::FrameAll:
      return frame_scene(bench_.camera, bench_.system(), bench_.snapshot().state, bench_.size.x / bench_.size.y);
    case Action::ShowPlots:
      panels_.plots_shown = !panels_.plots_shown;
      if (panels_.plots_shown && status().traces->traces.empty()) lab_.submit(Watch{first_plots(bench_.system())});
      return;
    case Action::HidePanels:
      panels_.panels_hidden = !panels_.panels_hidden;
      return;
    case Action::LightOrDark:
      panels_.look = panels_.look == Look::Dark ? Look::Light : Look::Dark;
      return;
    case Action::ShowKeys:
      panels_.keys_shown = !panels_.keys_shown;
      return;

    case Action::ShowGallery:
      panels_.gallery.is_shown = !panels_.gallery.is_shown;
      return;

    case Action::NewScene:
      return unless_unsaved(action);
    case Action::OpenScene:
      return panels_.ask(Dialog::Kind::Open);
    case Action::Save:
      return save();
    case Action::SaveAs:
      return ask_for_path();
    case Action::Quit:
      return unless_unsaved(action);
  }
}

void App::obey(const Request& request) {
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
                 [this](const OpenFile& open_file) { unless_unsaved(OpenFile{typed_path(open_file.file)}); },
                 [this](const SaveFile& save_file) {
                   if (save_to(typed_path(save_file.file))) go_on_after_saving();
                 },
                 [this](const ChooseTexture& choose) { choose_texture(choose.texture); },
                 [this](Answer given) { answer(given); },
             },
             request);
}

void App::tune(const Tuning& tuning, bool repeated) {
  if (!repeated) ++last_gesture_;
  for (const Command& command : tuning.commands) lab_.submit(command, last_gesture_);
  panels_.say(tuning.said);
}

// The nearest thing to leave: a menu, the keys, what the tool has half done, the selection, the tool.
void App::cancel() {
  if (panels_.menu_is_open) {
    panels_.menu_closes = true;
    return;
  }
  if (std::exchange(panels_.keys_shown, false) || std::exchange(panels_.gallery.is_shown, false)) return;
  tool_is_pressed_ = false;
  if (tool_->cancel(bench_)) return;
  if (!selection_.empty())
    selection_ = {};
  else
    take_tool(Action::SelectTool);
}

void App::delete_selection() {
  if (selection_.empty()) return;
  lab_.submit(Remove{selection_.points, selection_.springs});
  selection_ = {};
}

void App::release_nails() {
  SetNailed release;
  for (const Point& point : bench_.system().points())
    if (point.nailed) release.items.push_back({point.id, false});
  if (!release.items.empty()) lab_.submit(release);
}

void App::unless_unsaved(Request request) {
  settle();
  if (status().unsaved) {
    pending_ = std::move(request);
    return panels_.ask(Dialog::Kind::Unsaved);
  }
  pending_ = std::move(request);
  go_on_after_saving();
}

void App::answer(Answer given) {
  if (given == Answer::Cancel) pending_.reset();
  if (given == Answer::Discard) go_on_after_saving();
  if (given == Answer::Save) save();
}

// There is nothing more to lose: do what was asked for.
void App::go_on_after_saving() {
  const auto request = std::exchange(pending_, std::nullopt);
  if (!request) return;
  if (const auto* open_file = std::get_if<OpenFile>(&*request)) return open(open_file->file);
  if (*std::get_if<Action>(&*request) == Action::Quit)
    finished_ = true;
  else
    take_document(std::make_shared<const Scene>(empty_scene()), {});
}

void App::take_document(std::shared_ptr<const Scene> scene, std::filesystem::path file) {
  take_tool(tool_action_);
  selection_ = {};
  panels_.remarks.clear();
  panels_.gallery.is_shown = false;
  file_ = std::move(file);
  bench_.camera = make_camera(scene->view, scene->system, scene->state, bench_.size.x / bench_.size.y);
  take_switches(scene->view);
  lab_.submit(Open{std::move(scene)});
  settle();
}

void App::open(const std::filesystem::path& file) {
  const Opened opened = try_open(file);
  if (!opened.scene) return panels_.tell("Cannot open the scene", opened.error);
  take_document(opened.scene, file);
  panels_.remarks = opened.warnings;
}

bool App::save_to(const std::filesystem::path& file) {
  Scene scene = *lab_.copy_scene().get();
  scene.view.surface = panels_.view.surface;
  scene.view.springs = panels_.view.springs;
  scene.view.points = panels_.view.points;
  scene.view.strain_colors = panels_.view.strain_colors;
  const std::string error = try_save(scene, file);
  if (!error.empty()) {
    pending_.reset();
    panels_.tell("Cannot save the scene", error);
    return false;
  }
  file_ = file;
  lab_.submit(MarkSaved{});
  settle();
  panels_.say("Saved " + file.string());
  return true;
}

void App::save() {
  if (file_.empty() || is_shipped(file_)) return ask_for_path();
  if (save_to(file_)) go_on_after_saving();
}

// What hides it gives way.
void App::choose_texture(const std::string& typed) {
  ChosenTexture chosen = try_texture(typed, file_);
  if (!chosen.error.empty()) return panels_.tell("Cannot use the picture", chosen.error);
  if (!chosen.set.texture.empty()) {
    panels_.view.surface = true;
    panels_.view.strain_colors = panels_.view.strain_colors && panels_.view.springs;
  }
  lab_.submit(std::move(chosen.set));
}

void App::ask_for_path() {
  const bool own = !file_.empty() && !is_shipped(file_);
  panels_.ask(Dialog::Kind::Save, own ? file_.string() : typed_path(file_.empty() ? "untitled" : file_.stem()).string());
}

}  // namespace hooke
