// The export dialog: format, path, and for formats over time the duration and the quantities.
#include <imgui.h>
#include <imgui_stdlib.h>

#include "base/folder_listing.h"
#include "formats/file_kind.h"
#include "scene/quantity.h"
#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/typed_field.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

// Replaces the extension of another format.
void follow_kind(ExportState& export_state) {
  const std::string_view extension = export_kinds()[export_state.kind].extension;
  for (const FileKind& row : export_kinds())
    if (export_state.path.ends_with(row.extension)) export_state.path.resize(export_state.path.size() - row.extension.size());
  export_state.path += extension;
}

void kinds(ExportState& export_state, bool is_flat) {
  ImGui::PushStyleColor(ImGuiCol_FrameBg, palette::pressed);
  for (std::size_t i = 0; i < export_kinds().size(); ++i) {
    const FileKind& kind = export_kinds()[i];
    ImGui::BeginDisabled(kind.is_flat_only && !is_flat);
    if (ImGui::RadioButton((std::string(kind.label) + " (" + std::string(kind.extension) + ")").c_str(), export_state.kind == i)) {
      export_state.kind = i;
      follow_kind(export_state);
    }
    ImGui::EndDisabled();
  }
  ImGui::PopStyleColor();
}

void over_time(ExportState& export_state, bool is_flat, Panels& panels) {
  const FileKind& kind = export_kinds()[export_state.kind];
  if (kind.source != ExportSource::Frames) return;
  const NumberField field{.label = "Duration",
                          .unit = "s",
                          .description = "A copy of the scene runs from its current state; the scene on screen does not change.",
                          .min = 0.01,
                          .max = 600.0,
                          .default_value = 2.0,
                          .value = export_state.seconds,
                          .logarithmic = true};
  if (const auto value = number_row(field, panels)) export_state.seconds = *value;
  if (!kind.has_quantities) return;
  dim_text("Quantities, separated by commas");
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::InputText("##quantities", &export_state.quantities);
  ImGui::PushFont(fonts().small);
  paragraph(quantity_names(true, !is_flat) + ".", palette::dim);
  ImGui::PopFont();
}

void picture_rows(ExportState& export_state, const PanelInput& input, Panels& panels) {
  const FileKind& kind = export_kinds()[export_state.kind];
  if (kind.source != ExportSource::Picture && kind.source != ExportSource::Film) return;
  PictureOptions& picture = export_state.picture;
  ImGui::Checkbox("The whole window with its panels", &picture.panels);
  if (picture.panels) return;
  if (kind.has_alpha) ImGui::Checkbox("Transparent background", &picture.transparent);
  if (picture.width == 0) {
    const double pixels_per_unit = 1.0 / ImGui::GetIO().FontGlobalScale;
    picture.width = static_cast<int>(pixels_per_unit * input.layout.scene.width);
    picture.height = static_cast<int>(pixels_per_unit * input.layout.scene.height);
  }
  const auto size = [&](const char* label, int& pixels) {
    ImGui::PushID(label);
    if (const auto typed =
            typed_row({.label = label, .unit = "px", .min = 16.0, .max = 16384.0, .value = static_cast<double>(pixels)}, panels))
      pixels = static_cast<int>(*typed);
    ImGui::PopID();
  };
  size("Width", picture.width);
  size("Height", picture.height);
}

void buttons(const PanelInput& input, ExportState& export_state, Requests& requests) {
  const ExportWork& work = input.export_work;
  if (work.is_running) {
    progress_bar(work.fraction, work.seconds, -units(110.0));
    ImGui::SameLine();
    if (ImGui::Button("Stop", {units(96.0), units(30.0)})) requests.emplace_back(StopExport{});
    return;
  }
  // Enter goes to the button that replaces a file, and only there presses it
  std::error_code error;
  const auto file = resolve_typed_path(export_state.path, std::filesystem::current_path(error));
  const bool replaces = std::filesystem::is_regular_file(file, error), enter = input.presses(PanelKey::Target::Export, Key::Enter) > 0;
  if (replaces) text_in(palette::warning, "A file with this name exists");
  if (enter && has_focused_item()) press_focused_item();
  if (enter && !has_focused_item() && replaces) ImGui::SetKeyboardFocusHere();
  ImGui::PushStyleColor(ImGuiCol_Button, palette::tinted);
  const bool clicked = ImGui::Button(replaces ? "Replace" : "Export", {units(96.0), units(30.0)});
  ImGui::PopStyleColor();
  if (clicked || (enter && !replaces && !has_focused_item())) requests.emplace_back(StartExport{});
  ImGui::SameLine();
  if (ImGui::Button("Cancel", {units(96.0), units(30.0)})) export_state.is_shown = false;
}

}  // namespace

void build_export(const PanelInput& input, Panels& panels, Requests& requests) {
  ExportState& export_state = panels.export_state;
  if (!export_state.is_shown) return;
  if (export_state.is_new) follow_kind(export_state);
  const Rect &scene = input.layout.scene, &page = input.layout.page;
  const float wide = box_width(480.0);
  ImGui::SetNextWindowPos({middle_for(scene, wide), static_cast<float>(page.y + 0.5 * page.height)}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({wide, 0.0f}, {wide, static_cast<float>(page.height)});
  begin_front_box("export", {units(20.0), units(16.0)});
  panels.shown.floating.push_back(current_window());

  strong_text("Export");
  begin_tab_stops();
  ImGui::BeginDisabled(input.export_work.is_running);
  const bool is_flat = input.status.snapshot->system->dimensions == 2;
  kinds(export_state, is_flat);
  ImGui::Dummy({0.0f, units(2.0)});
  paragraph(export_kinds()[export_state.kind].description, palette::dim);
  over_time(export_state, is_flat, panels);
  picture_rows(export_state, input, panels);
  dim_text("Path");
  if (export_state.is_new) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1.0f);
  if (const RareCharacters kept(export_state.path); true) ImGui::InputText("##path", &export_state.path);
  ImGui::EndDisabled();
  export_state.is_new = false;
  ImGui::Dummy({0.0f, units(4.0)});
  buttons(input, export_state, requests);
  end_tab_stops();
  end_front_box();
}

}  // namespace hooke
