// The effect of each action of ui/actions.inc and each request of the panels.
#include <algorithm>
#include <glm/geometric.hpp>

#include "app/app.h"
#include "app/document/files.h"
#include "base/overloaded.h"
#include "base/printable.h"
#include "device/gpu_device.h"
#include "scene/parameters.h"
#include "study/compare_methods.h"

namespace hooke {
namespace {

// Between two presses that belong together.
constexpr std::chrono::milliseconds tuning_pause{800};

}  // namespace

// `repeated`: the key of the action is held down.
void App::perform(Action action, [[maybe_unused]] bool repeated) {
  switch (action) {
#define TOOL(id, ...) \
  case Action::id:    \
    return tool_.take(Action::id);
#define ACTION(id, keys, position, needs, group, text, ...) \
  case Action::id:                                          \
    __VA_ARGS__;                                            \
    return;
#include "ui/actions.inc"
  }
}

void App::handle(const Request& request) {
  std::visit(Overloaded{
                 [this](const Edit& edit) {
                   if (!edit.continues) tool_context_.begin_gesture();
                   const auto& collider = tool_context_.selection.collider;
                   if (const auto* set = std::get_if<SetColliders>(&edit.command); set && collider)
                     tool_context_.note_gaps(set->colliders[static_cast<std::size_t>(*collider)]);
                   lab_.submit(edit.command, tool_context_.last_gesture, edit.name);
                 },
                 [this](const Scrub& scrub) {
                   if (!scrub.continues) tool_context_.begin_gesture();
                   lab_.submit(GoToTime{scrub.time}, tool_context_.last_gesture);
                 },
                 [this](const Control& control) {
                   if (const auto* accuracy = std::get_if<SetAccuracy>(&control))
                     settings_.set_measure_accuracy(accuracy->mode != AccuracyMode::Off);
                   lab_.submit(control);
                 },
                 [this](Action action) { perform(action); },
                 [this](const OpenFile& open_file) { document_.open(typed_path(open_file.file), open_file.options); },
                 [this](const SaveFile& save_file) { document_.save_to(typed_path(save_file.file)); },
                 [this](const ChooseTexture& choose) { choose_texture(choose.texture); },
                 [this](const LookFrom& look) { camera_control_.look_from(look.direction); },
                 [this](const OpenSystemDialog& open_dialog) { document_.open_system_dialog(open_dialog.to_save); },
                 [this](const Recover& wanted) { document_.recover(wanted.which); },
                 [this](const DiscardRecovery& unwanted) { document_.discard_recovery(unwanted.which); },
                 [this](const CancelWork&) { file_task_.stop(); },
                 [this](const StopComparison&) { work_.comparison.stop(); },
                 [this](const StopResultCheck&) { work_.result_check.stop(); },
                 [this](const ExplainStretch&) { work_.start_stretch(status(), tool_context_.selection.springs); },
                 [this](const SaveComparison& save) { save_comparison(save.extension); },
                 [this](const SetGhosts& ghosts) { work_.ghosts.set(ghosts, status(), lab_); },
                 [this](const ShowFailure&) { show_failure(); },
                 [this](const StartExport&) { exporter_.start(); },
                 [this](const StopExport&) { exporter_.stop(); },
                 [this](const Select& select) { tool_context_.selection = select.selection; },
                 [this](const StartPlacement& start) { start_placement(start); },
                 [](const CloseDialog&) {},
                 [this](const LoadMesh& load) { placer_.read_mesh(typed_path(load.file)); },
                 [this](const Place&) { placer_.place(); },
                 [this](const StopPlacement&) { placer_.stop(); },
                 [this](Answer given) { document_.answer(given); },
             },
             request);
}

// Presses of the keys of one value in quick succession are one step of undo, as the drag of its slider is.
void App::tune(const Tuning& tuning, TunedBy keys, bool repeated) {
  const auto now = std::chrono::steady_clock::now();
  const auto& last = keyboard_.tuned;
  const bool continues =
      repeated || (last && last->keys == keys && last->gesture == tool_context_.last_gesture && now - last->at < tuning_pause);
  if (!continues) tool_context_.begin_gesture();
  keyboard_.tuned = {keys, tool_context_.last_gesture, now};
  for (const Command& command : tuning.commands) lab_.submit(command, tool_context_.last_gesture);
  panels_.show_value(tuning.message);
}

void App::start_placement(const StartPlacement& start) {
  if (start.in_space) {
    lab_.submit(SetParameter{&dimensions_parameter, 1.0});
    settle();
  }
  // its panel is at the left, too
  bool is_shown = false;
  show_or_hide_at_left(&is_shown);
  if (start.collider != nullptr)
    placer_.start(*start.collider);
  else
    placer_.start(start.shape);
}

void App::set_start() {
  lab_.submit(SetStart{});
  panels_.show_toast("This is the start now: " + key_text(shortcut_of(Action::GoToStart)) + " returns to it");
}

// Cancels the innermost state: an interaction of the tool, the selection, the tool.
void App::cancel() {
  panels_.messages.toast.clear();
  if (tool_.cancel()) return;
  if (!tool_context_.selection.empty())
    tool_context_.selection = {};
  else
    tool_.take(Action::SelectTool);
}

void App::compare_methods() {
  panels_.shown.comparison = false;
  show_or_hide_at_left(&panels_.shown.comparison);
  work_.start_comparison(status());
}

void App::check_result() {
  panels_.shown.result_check = false;
  show_or_hide_at_left(&panels_.shown.result_check);
  work_.start_result_check(status());
}

// Shows the panel with a very accurate run, or with a first setting to compare with; hides it if it is already shown.
void App::show_ghosts(bool with_reference) {
  Ghosts& ghosts = panels_.ghosts;
  if (ghosts.is_shown) {
    ghosts = {};
  } else {
    if (placer_.is_on()) placer_.stop();
    panels_.show_at_left(&ghosts.is_shown);
    ghosts.with_reference = with_reference;
    if (!with_reference) ghosts.settings = {first_ghost(status().snapshot->settings)};
  }
  work_.ghosts.set({ghosts.with_reference, ghosts.settings}, status(), lab_);
}

void App::save_comparison(const std::string& extension) {
  const auto result = work_.comparison.status().result;
  if (!result) return;
  const std::filesystem::path file = document_.new_file_beside("-methods" + extension);
  const std::string error = write_comparison(*result, file);
  if (error.empty())
    panels_.show_toast("Saved to " + printable(file.native()));
  else
    panels_.show_message("Cannot write the chart", error);
}

void App::show_failure() {
  const auto& divergence = status().snapshot->divergence;
  if (!divergence) return;
  tool_context_.selection = {};
  if (divergence->spring)
    tool_context_.selection.springs = {*divergence->spring};
  else if (divergence->point)
    tool_context_.selection.points = {*divergence->point};
  camera_control_.fly_to_selection();
}

// Closes the gallery, because commands act on the scene.
void App::open_search() {
  panels_.gallery.is_shown = false;
  panels_.search = {.shown = true, .is_new = true};
}

void App::show_or_hide_plots() {
  panels_.plots.table.is_shown = false;
  panels_.plots.is_shown = !panels_.plots.is_shown;
  if (!panels_.plots.is_shown) return;
  const double width = tool_context_.layout.menu.width, height = tool_context_.layout.status.y + tool_context_.layout.status.height;
  if (lay_out(width, height, tool_context_.scale, {.plots = true}).plots.height == 0.0)
    panels_.show_toast("The window is not high enough for plots: make it higher");
}

void App::show_or_hide_table() {
  panels_.plots.is_shown = false;
  panels_.plots.table.is_shown = !panels_.plots.table.is_shown;
}

void App::show_or_hide_at_left(bool* panel) {
  if (*panel) {
    *panel = false;
    return;
  }
  if (placer_.is_on()) placer_.stop();
  panels_.show_at_left(panel);
  work_.ghosts.set({}, status(), lab_);
}

void App::release_nails() {
  if (std::ranges::none_of(tool_context_.system().points(), &Point::nailed)) return panels_.show_toast("No point is nailed");
  lab_.submit(ReleaseNails{});
}

void App::switch_muscles() {
  const auto moves = [](const Spring& spring) { return spring.law && spring.law->moves(); };
  if (std::ranges::none_of(tool_context_.system().springs(), moves))
    return panels_.show_toast("This scene has no muscles or winches: select a spring and choose its law");
  const bool on = !status().snapshot->system->muscles.on;
  lab_.submit(SetParameter{find_parameter("muscles"), on ? 1.0 : 0.0});
  panels_.show_toast(on ? "Muscles and winches move" : "Muscles and winches stand still");
}

// The GPU computes what it can from the next frame on, or the CPU does again.
void App::switch_device() {
  if (status().run.on_device) {
    lab_.submit(SetDevice{});
    return panels_.show_toast("Computed on the CPU");
  }
  try {
    const auto gpu = std::make_shared<GpuDevice>();
    lab_.submit(SetDevice{gpu});
    panels_.show_toast("Computed on the GPU: " + gpu->renderer());
  } catch (const std::runtime_error& error) {
    panels_.show_toast("Computed on the CPU: " + std::string(error.what()));
  }
}

// The surface is shown, and without strain colors, so that the texture is visible.
void App::choose_texture(const std::string& typed) {
  ChosenTexture chosen = try_texture(typed, document_.file());
  if (!chosen.error.empty()) return panels_.show_message("Cannot use the texture", chosen.error);
  if (!chosen.set.texture.empty()) {
    panels_.view.surface = true;
    panels_.view.strain_colors = panels_.view.strain_colors && panels_.view.springs;
  }
  lab_.submit(std::move(chosen.set));
}

}  // namespace hooke
