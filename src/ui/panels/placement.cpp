// The panel of a shape that is being placed, made from its row: supports, dimensions, rotation.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "ui/docked_panel.h"
#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

std::string display_text(std::string_view support_name) {
  std::string text(support_name);
  for (char& c : text)
    if (c == '_') c = ' ';
  return text;
}

void support_row(const PanelInput& input, Shape& shape, Panels& panels) {
  if (shape.kind->supports.size() < 2) return;
  begin_row("Supports");
  ImGui::SetNextItemWidth(-1.0f);
  if (!ImGui::BeginCombo("##held", display_text(shape.support_name()).c_str())) return;
  close_on_escape(input, panels);
  for (std::size_t i = 0; i < shape.kind->supports.size(); ++i)
    if (ImGui::Selectable(display_text(shape.kind->supports[i]).c_str(), i == shape.support)) shape.support = i;
  ImGui::EndCombo();
}

void number_rows(Shape& shape, bool is_flat, Panels& panels) {
  for (std::size_t i = 0; i < shape.kind->numbers.size(); ++i) {
    const ShapeNumber& row = shape.kind->numbers[i];
    if (is_flat && row.is_3d_only) continue;
    ImGui::PushID(row.name.data());
    if (const auto value = number_row(field_of_row(row, shape.values[i]), panels)) shape.values[i] = *value;
    ImGui::PopID();
  }
}

void angle_rows(Shape& shape, Panels& panels) {
  struct Angle {
    const char* label;
    double& value;
  };
  for (const Angle& angle : {Angle{"Turn", shape.turn}, Angle{"Tilt", shape.tilt}}) {
    ImGui::PushID(angle.label);
    const NumberField field{.label = angle.label,
                            .unit = "degrees",
                            .description = {},
                            .min = -180.0,
                            .max = 180.0,
                            .default_value = 0.0,
                            .value = angle.value};
    if (const auto value = number_row(field, panels)) angle.value = *value;
    ImGui::PopID();
  }
}

void mesh_rows(const PanelInput& input, Placement& placement, Panels& panels, Requests& requests) {
  dim_text("Path of an .obj file");
  constexpr const char* browse = "Browse...";
  const float button = ImGui::CalcTextSize(browse).x + units(24.0);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - units(8.0));
  if (const RareCharacters kept(placement.mesh_path); true) ImGui::InputText("##mesh", &placement.mesh_path);
  if (ImGui::IsItemDeactivatedAfterEdit() && !placement.mesh_path.empty()) requests.emplace_back(LoadMesh{placement.mesh_path});
  ImGui::SameLine();
  if (ImGui::Button(browse, {button, 0.0f})) {
    panels.open_file_dialog(Dialog::Kind::Open, input.folder);
    panels.dialog.picks_mesh = true;
    panels.dialog.title = "Choose a mesh";
  }
  dim_text(placement.mesh_info.empty() ? "No mesh yet" : placement.mesh_info);
  begin_row("Obstacle");
  ImGui::Checkbox("##obstacle", &placement.is_obstacle);
  tooltip("Its points are nailed, and other parts touch its faces: a closed mesh is a solid body");
  if (placement.is_obstacle) paragraph("Other parts touch its faces.", palette::dim);
  struct Number {
    NumberField field;
    double& value;
  };
  const Number numbers[] = {
      {{.label = "Size", .unit = "m", .description = "Length of the longest side.", .min = 0.01, .max = 100.0, .default_value = 1.0},
       placement.mesh_size},
      {{.label = "Stretch E t",
        .unit = "N/m",
        .description = "Young's modulus times thickness.",
        .min = 0.01,
        .max = 1e6,
        .default_value = placement.mesh_stiffness},
       placement.mesh_stiffness},
      {{.label = "Density", .unit = "kg/m^2", .description = "Mass per area.", .min = 0.001, .max = 100.0, .default_value = 0.2},
       placement.mesh_density},
      {{.label = "Damping \u03b7",
        .unit = "N s/m",
        .description = "Viscosity times thickness.",
        .min = 0.0,
        .max = 1e4,
        .default_value = placement.mesh_damping},
       placement.mesh_damping},
  };
  for (const Number& number : numbers) {
    NumberField field = number.field;
    field.value = number.value;
    field.logarithmic = true;
    ImGui::PushID(field.label.data());
    if (const auto value = number_row(field, panels)) number.value = *value;
    ImGui::PopID();
  }
}

void placement_rows(const PanelInput& input, Placement& placement, Panels& panels, Requests& requests) {
  const bool is_flat = input.status.snapshot->system->dimensions == 2;
  if (placement.collider) {
    paragraph(kind_of(*placement.collider).description, palette::dim);
    if (const auto changed = collider_rows(*placement.collider, is_flat ? 2 : 3, panels)) placement.collider = changed;
    return paragraph("Click or drag in the scene to move it.", palette::dim);
  }
  paragraph(placement.is_mesh ? "Triangles and quads become cloth, in the orientation of the file." : placement.shape.kind->description,
            palette::dim);
  ImGui::Dummy({0.0f, units(3.0)});
  if (placement.is_mesh) {
    mesh_rows(input, placement, panels, requests);
  } else {
    support_row(input, placement.shape, panels);
    number_rows(placement.shape, is_flat, panels);
  }
  if (!is_flat) angle_rows(placement.shape, panels);
  ImGui::Dummy({0.0f, units(4.0)});
  paragraph("Click or drag in the scene to move it.", palette::dim);
}

void placement_buttons(Placement& placement, Requests& requests) {
  const bool is_empty = placement.is_mesh && placement.mesh_info.empty();
  ImGui::BeginDisabled(is_empty);
  ImGui::PushStyleColor(ImGuiCol_Button, palette::tinted);
  if (ImGui::Button("Place", {units(96.0), units(30.0)})) requests.emplace_back(Place{});
  ImGui::PopStyleColor();
  ImGui::EndDisabled();
  if (is_empty) tooltip("Choose an .obj file first");
  ImGui::SameLine();
  if (ImGui::Button("Cancel", {units(96.0), units(30.0)})) requests.emplace_back(StopPlacement{});
}

}  // namespace

void build_placement(const PanelInput& input, Panels& panels, Requests& requests) {
  Placement& placement = panels.placement;
  if (!placement.is_on()) return;
  DockedPanel panel("placing", placement_dock(input.layout, units(1.0)), panels);
  strong_text(placement.collider  ? kind_of(*placement.collider).label.data()
              : placement.is_mesh ? "From a mesh"
                                  : placement.shape.kind->label.data());
  panel.begin_content();
  placement_rows(input, placement, panels, requests);
  panel.end_content();
  placement_buttons(placement, requests);
}

}  // namespace hooke
