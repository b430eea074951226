// The panel on the right: the scene, the selection, the parameters, the forces, the energy, the history.
#include <glm/geometric.hpp>
#include <utility>

#include "base/printable.h"
#include "draw/colors.h"
#include "scene/parameter_groups.h"
#include "ui/panels.h"
#include "ui/strain_legend.h"
#include "ui/text.h"
#include "ui/typed_field.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

void scene_section(const PanelInput& input) {
  const System& system = *input.status.snapshot->system;
  ImGui::PushFont(fonts().strong);
  paragraph(printable(input.status.document->name.empty() ? "Untitled" : input.status.document->name));
  ImGui::PopFont();
  if (!input.status.document->description.empty()) paragraph(printable(input.status.document->description), palette::dim);
  if (!input.status.document->notes.empty()) paragraph(printable(input.status.document->notes));
  dim_text(count(system.point_count(), "point") + ", " + count(system.spring_count(), "spring") + (system.dimensions == 2 ? ", flat" : ""));
}

// Fields for the texts of the scene, which are saved with it.
void text_section(const PanelInput& input, Panels& panels, Requests& requests) {
  if (!section("Title and notes", "", false)) return;
  const DocumentStatus& document = *input.status.document;
  SetText set{document.name, document.description, document.notes};
  bool changed = false;
  const auto field = [&](const char* label, std::string& text, float lines) {
    dim_text(label);
    ImGui::PushID(label);
    changed = text_field(text, lines, panels) || changed;
    ImGui::PopID();
  };
  field("Title", set.title, 0.0f);
  field("Description", set.description, 4.0f);
  field("Notes", set.notes, 5.0f);
  if (changed) requests.emplace_back(Edit{std::move(set)});
}

void legend_section(const PanelInput& input, const Panels& panels) {
  if (!shows_strain_colors(*input.status.snapshot->system, panels.view)) return;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  draw_strain_legend(*input.status.snapshot, {at.x, at.y + units(4.0)}, width, *ImGui::GetWindowDrawList());
  ImGui::Dummy({width, units(strain_legend_height + 4.0)});
}

// What the highlighted parts are, in their color.
void crossed_section(const PanelInput& input, const Panels& panels) {
  if (input.marks == nullptr || !input.marks->crossed) return;
  for (const CrossedText& text : describe(*input.marks->crossed, *input.status.snapshot->system))
    paragraph(text.count + ", as highlighted: " + text.consequence + ".", to_imgui(palette_for(background_of(panels.look)).crossed));
}

void energy_row(const char* name, const std::string& value, ImU32 text_color = palette::text) {
  dim_text(name);
  ImGui::SameLine();
  ImGui::SetCursorPosX(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(value.c_str()).x);
  text_in(text_color, value);
}

void energy_section(const Status& status) {
  const Snapshot& snapshot = *status.snapshot;
  energy_row("Kinetic", quantity_text(snapshot.energy.kinetic, "J"));
  energy_row("Elastic", quantity_text(snapshot.energy.elastic, "J"));
  energy_row("Gravitational", quantity_text(snapshot.energy.gravitational, "J"));
  energy_row("Total", quantity_text(snapshot.energy.total(), "J"));
  if (snapshot.system->strain_limit > 0.0) {
    // the limit is not physical: the energy that it removes is shown next to that of the scene
    const ImU32 text_color = status.run.limit_power != 0.0 ? palette::warning : palette::text;
    energy_row("Strain limit", quantity_text(status.run.limit_power, "W") + ", " + quantity_text(status.run.limit_work, "J") + " in total",
               text_color);
  }
  energy_row("Momentum", quantity_text(glm::length(snapshot.momentum.linear), "kg m/s"));
}

}  // namespace

void build_side(const PanelInput& input, Panels& panels, Requests& requests) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(14.0), units(12.0)});
  begin_panel("side", input.layout.side);
  ImGui::PopStyleVar();
  // another scene is read from its top, with the groups that it is about open
  const bool is_about_forces = has_forces_first(input);
  if (std::exchange(panels.side.to_top, false)) {
    ImGui::SetScrollY(0.0f);
    open_section(forces_section, is_about_forces);
    open_section(std::string(parameter_group::contact), input.status.snapshot->system->contact.any());
  }
  scene_section(input);
  build_lesson(input, panels);
  crossed_section(input, panels);
  legend_section(input, panels);
  build_inspector(input, panels, requests);
  build_parameters(input, panels, requests);
  if (!is_about_forces) build_forces(input, panels, requests);
  if (section("Energy")) energy_section(input.status);
  text_section(input, panels, requests);
  build_history(input, requests);
  ImGui::End();
}

}  // namespace hooke
