// The forces of the scene, made from the rows of their table: each with a switch, parameters and a remove button, and a list to add one.
#include "sim/forces/force_terms.h"
#include "sim/forces/terms/gas_leak.h"
#include "sim/model/system.h"
#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

constexpr std::string_view along_z = "z";  // name of the number of a force that a flat scene does not have

// The switch, the name and the remove button. Returns false if the force was removed.
bool heading(Force& force) {
  const float end = ImGui::GetContentRegionMax().x, side = ImGui::GetFrameHeight();
  ImGui::Checkbox("##on", &force.on);
  tooltip(std::string(force.term->description));
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(force.term->label.data());
  tooltip(std::string(force.term->description));
  ImGui::SameLine(end - side);
  const bool removed = icon_button("remove", Icon::Delete, {side, side});
  tooltip("Remove this force");
  return !removed;
}

// The force of the opened scene at this place in the list, or null.
const Force* opened_force(const PanelInput& input, const Force& force, std::size_t place) {
  const std::vector<Force>& opened = input.status.document->opened_forces;
  return place < opened.size() && opened[place].term == force.term ? &opened[place] : nullptr;
}

void choice_row(const ForceParameter& row, double& value, const PanelInput& input, Panels& panels) {
  begin_row(std::string(row.label));
  ImGui::SetNextItemWidth(-1.0f);
  if (!ImGui::BeginCombo("##choice", row.choices[static_cast<std::size_t>(value)].label.data())) return;
  close_on_escape(input, panels);
  for (std::size_t i = 0; i < row.choices.size(); ++i)
    if (ImGui::Selectable(row.choices[i].label.data(), static_cast<double>(i) == value)) value = static_cast<double>(i);
  ImGui::EndCombo();
}

// Resets to the value that the opened scene gives.
void value_row(const ForceParameter& row, double& value, double reset_value, Panels& panels) {
  NumberField field = field_of_row(row, value);
  field.default_value = reset_value;
  field.typed = row.valid();
  if (const auto changed = number_row(field, panels)) value = *changed;
}

}  // namespace

void build_forces(const PanelInput& input, Panels& panels, Requests& requests) {
  const std::vector<Force>& now = input.status.snapshot->system->forces;
  if (!section(forces_section, now.empty() ? "" : std::to_string(now.size()), !now.empty())) return;

  const bool is_flat = input.status.snapshot->system->dimensions == 2;
  std::vector<Force> wanted;
  for (std::size_t f = 0; f < now.size(); ++f) {
    Force force = now[f];
    ImGui::PushID((std::string(force.term->id) + ' ' + std::to_string(f)).c_str());
    const bool stays = heading(force);
    for (std::size_t i = 0; i < force.term->numbers.size() && force.on; ++i) {
      const ForceParameter& row = force.term->numbers[i];
      if (is_flat && row.name == along_z) continue;
      ImGui::PushID(row.name.data());
      const Force* opened = opened_force(input, force, f);
      if (row.choices.empty())
        value_row(row, force.values[i], opened != nullptr ? opened->values[i] : row.default_value, panels);
      else
        choice_row(row, force.values[i], input, panels);
      ImGui::PopID();
    }
    ImGui::PopID();
    continue_leak(now[f], input.status.snapshot->state.time, force);
    if (stays) wanted.push_back(force);
  }

  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::BeginCombo("##add", "Add a force...", ImGuiComboFlags_HeightLarge)) {
    close_on_escape(input, panels);
    for (const ForceTerm& term : force_terms()) {
      if (ImGui::Selectable(term.label.data())) {
        wanted.push_back({&term, true, default_values(term)});
        for (std::size_t i = 0; i < term.numbers.size(); ++i)
          if (is_flat && term.numbers[i].name == along_z) wanted.back().values[i] = 0.0;
      }
      tooltip(std::string(term.description));
    }
    ImGui::EndCombo();
  }
  if (wanted == now) return;
  requests.emplace_back(Edit{SetForces{std::move(wanted)}, panels.field.edit_in_progress});
  panels.field.edit_in_progress = true;
}

}  // namespace hooke
