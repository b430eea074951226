// The panel of a shape that is about to be placed, made from its row: how it is held, its numbers, how it is turned.
#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

std::string in_words(std::string_view hold) {
  std::string words(hold);
  for (char& c : words)
    if (c == '_') c = ' ';
  return words;
}

void hold_row(Shape& shape) {
  if (shape.kind->holds.size() < 2) return;
  begin_row("Held by");
  ImGui::SetNextItemWidth(-1.0f);
  if (!ImGui::BeginCombo("##held", in_words(shape.hold()).c_str())) return;
  for (std::size_t i = 0; i < shape.kind->holds.size(); ++i)
    if (ImGui::Selectable(in_words(shape.kind->holds[i]).c_str(), i == shape.held)) shape.held = i;
  ImGui::EndCombo();
}

void number_rows(Shape& shape, bool is_flat, Panels& panels) {
  for (std::size_t i = 0; i < shape.kind->numbers.size(); ++i) {
    const ShapeNumber& row = shape.kind->numbers[i];
    if (is_flat && row.spatial) continue;
    ImGui::PushID(row.name.data());
    if (const auto value = number_row(field_of_row(row, shape.values[i], row.whole), panels)) shape.values[i] = *value;
    ImGui::PopID();
  }
}

void angle_rows(Shape& shape, Panels& panels) {
  struct Angle {
    const char* label;
    double& value;
  };
  for (const Angle& angle : {Angle{"Turned", shape.turn}, Angle{"Tilted", shape.tilt}}) {
    ImGui::PushID(angle.label);
    const NumberField field{
        .label = angle.label, .unit = "degrees", .meaning = {}, .least = -180.0, .most = 180.0, .usual = 0.0, .value = angle.value};
    if (const auto value = number_row(field, panels)) angle.value = *value;
    ImGui::PopID();
  }
}

void mesh_rows(Placing& placing, Panels& panels) {
  dim_text("Path of an .obj file");
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::InputText("##mesh", &placing.mesh_path, ImGuiInputTextFlags_EnterReturnsTrue)) placing.wants_mesh = true;
  placing.types_path = ImGui::IsItemActive();
  if (ImGui::Button("Load")) placing.wants_mesh = true;
  ImGui::SameLine();
  dim_text(placing.mesh_remark);
  const NumberField field{.label = "Size",
                          .unit = "m",
                          .meaning = {},
                          .least = 0.01,
                          .most = 100.0,
                          .usual = 1.0,
                          .value = placing.mesh_size,
                          .logarithmic = true};
  if (const auto value = number_row(field, panels)) placing.mesh_size = *value;
}

}  // namespace

void build_placing(const Desk& desk, Panels& panels) {
  Placing& placing = panels.placing;
  if (!placing.is_on()) return;
  const Rect& scene = desk.layout.scene;
  const bool is_flat = desk.status.snapshot->system->dimensions == 2;
  ImGui::SetNextWindowPos({static_cast<float>(scene.x) + units(14.0), static_cast<float>(scene.y) + units(14.0)});
  const float wide = std::min(units(310.0), std::max(1.0f, static_cast<float>(scene.width) - units(28.0)));
  ImGui::SetNextWindowSizeConstraints({wide, 0.0f}, {wide, std::max(1.0f, static_cast<float>(desk.layout.page.height) - units(28.0))});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, units(8.0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(16.0), units(12.0)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::box);
  ImGui::Begin("placing", nullptr, front_box);
  panels.floating.push_back(current_window());

  ImGui::PushFont(fonts().strong);
  ImGui::TextUnformatted(placing.of_mesh ? "From a mesh" : placing.shape.kind->label.data());
  ImGui::PopFont();
  ImGui::PushTextWrapPos(0.0f);
  dim_text(placing.of_mesh ? "Triangles and quads become cloth, lying as they are drawn." : std::string(placing.shape.kind->meaning));
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0.0f, units(3.0)});
  if (placing.of_mesh) {
    mesh_rows(placing, panels);
  } else {
    hold_row(placing.shape);
    number_rows(placing.shape, is_flat, panels);
  }
  if (!is_flat) angle_rows(placing.shape, panels);

  ImGui::Dummy({0.0f, units(4.0)});
  ImGui::PushTextWrapPos(0.0f);
  dim_text("Click or drag in the scene to move it there.");
  ImGui::PopTextWrapPos();
  ImGui::PushStyleColor(ImGuiCol_Button, palette::tinted);
  if (ImGui::Button("Place", {units(96.0), units(30.0)})) placing.wants_place = true;
  ImGui::PopStyleColor();
  ImGui::SameLine();
  if (ImGui::Button("Cancel", {units(96.0), units(30.0)})) placing.stop();
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
}

}  // namespace hooke
