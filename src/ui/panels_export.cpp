// The box of Ctrl+E: what for, where to, and for what happens in time how long and which quantities.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <array>

#include "lab/quantity.h"
#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

constexpr std::array rows{
    ExportKind{".obj", "Mesh", "Points, faces and loose springs as they stand now, in the Wavefront format.", false, false, false},
    ExportKind{".ply", "Mesh with strain", "The same in the Stanford format, with the strain at every vertex.", false, false, false},
    ExportKind{".pc2", "Point cache", "Where every point is in every frame from now on: Blender's Mesh Cache plays it on the .obj.", true,
               false, false},
    ExportKind{".csv", "Table", "Quantities in every frame from now on.", true, true, false},
    ExportKind{".csv", "Plots", "What the plots show, as far back as the frames of the run go.", false, true, false},
    ExportKind{".xsp", "XSpringies", "A flat scene for XSpringies, as it stands now.", false, false, true},
    ExportKind{".png", "Picture", "The scene as it is seen now, without the panels.", false, false, false},
};

// The ending that the kind has, in place of another kind's.
void follow_kind(Exporting& exporting) {
  const std::string_view extension = rows[exporting.kind].extension;
  for (const ExportKind& row : rows)
    if (exporting.path.ends_with(row.extension)) exporting.path.resize(exporting.path.size() - row.extension.size());
  exporting.path += extension;
}

void kinds(Exporting& exporting, bool is_flat) {
  ImGui::PushStyleColor(ImGuiCol_FrameBg, palette::pressed);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ImGui::BeginDisabled(rows[i].flat_only && !is_flat);
    if (ImGui::RadioButton((std::string(rows[i].label) + " (" + std::string(rows[i].extension) + ")").c_str(), exporting.kind == i)) {
      exporting.kind = i;
      follow_kind(exporting);
    }
    ImGui::EndDisabled();
  }
  ImGui::PopStyleColor();
}

void over_time(Exporting& exporting, Panels& panels) {
  const ExportKind& kind = rows[exporting.kind];
  if (!kind.over_time) return;
  const NumberField field{.label = "From now on",
                          .unit = "s",
                          .meaning = "The scene is run on from where it stands; what is on the screen stays.",
                          .least = 0.01,
                          .most = 600.0,
                          .usual = 2.0,
                          .value = exporting.seconds,
                          .logarithmic = true};
  if (const auto value = number_row(field, panels)) exporting.seconds = *value;
  if (!kind.quantities) return;
  dim_text("Quantities, with commas between");
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::InputText("##quantities", &exporting.quantities);
  ImGui::PushTextWrapPos(0.0f);
  ImGui::PushFont(fonts().small);
  dim_text(quantity_names() + ".");
  ImGui::PopFont();
  ImGui::PopTextWrapPos();
}

void buttons(Exporting& exporting) {
  if (exporting.is_running()) {
    progress_bar(exporting.share, exporting.running_seconds, -units(110.0));
    ImGui::SameLine();
    if (ImGui::Button("Stop", {units(96.0), units(30.0)})) exporting.wants_stop = true;
    return;
  }
  ImGui::PushStyleColor(ImGuiCol_Button, palette::tinted);
  if (ImGui::Button("Export", {units(96.0), units(30.0)})) exporting.wants_export = true;
  ImGui::PopStyleColor();
  ImGui::SameLine();
  if (ImGui::Button("Cancel", {units(96.0), units(30.0)})) exporting.is_shown = false;
}

}  // namespace

std::span<const ExportKind> export_kinds() { return rows; }

void build_export(const Desk& desk, Panels& panels) {
  Exporting& exporting = panels.exporting;
  if (!exporting.is_shown) return;
  if (exporting.is_new) follow_kind(exporting);
  const Rect &scene = desk.layout.scene, &page = desk.layout.page;
  const float wide = box_width(480.0);
  ImGui::SetNextWindowPos({middle_for(scene, wide), static_cast<float>(page.y + 0.5 * page.height)}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({wide, 0.0f}, {wide, static_cast<float>(page.height)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, units(8.0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(20.0), units(16.0)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::box);
  ImGui::Begin("export", nullptr, front_box);
  panels.floating.push_back(current_window());

  ImGui::PushFont(fonts().strong);
  ImGui::TextUnformatted("Export");
  ImGui::PopFont();
  ImGui::BeginDisabled(exporting.is_running());
  kinds(exporting, desk.status.snapshot->system->dimensions == 2);
  ImGui::Dummy({0.0f, units(2.0)});
  ImGui::PushTextWrapPos(0.0f);
  dim_text(std::string(rows[exporting.kind].meaning));
  ImGui::PopTextWrapPos();
  over_time(exporting, panels);
  dim_text("Path");
  if (exporting.is_new) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::InputText("##path", &exporting.path);
  ImGui::EndDisabled();
  exporting.is_new = false;
  ImGui::Dummy({0.0f, units(4.0)});
  buttons(exporting);
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
}

}  // namespace hooke
