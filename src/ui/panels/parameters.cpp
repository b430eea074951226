// Sliders and switches, made from the rows of the parameter table, with their effect on the current scene.
#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/parameters.h"
#include "sim/integrator.h"
#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/panels/parameter_hints.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

void edit(Command command, Panels& panels, Requests& requests) {
  requests.emplace_back(Edit{std::move(command), panels.edit_in_progress});
  panels.edit_in_progress = true;
}

NumberField field_of(const Parameter& row, const ControlRanges& controls, double value) {
  NumberField field{.label = row.label,
                    .unit = row.unit,
                    .description = row.description,
                    .min = row.min,
                    .max = row.max,
                    .default_value = row.default_value,
                    .value = value,
                    .integer = row.kind == Parameter::Kind::Integer,
                    .logarithmic = row.logarithmic};
  const bool is_stiffness = &row == &stiffness_parameter || &row == &new_stiffness_parameter;
  if (is_stiffness && controls.stiffness_max > 0.0) {
    field.min = controls.stiffness_min;
    field.max = controls.stiffness_max;
    field.step = controls.stiffness_step;
    field.default_value = std::clamp(field.default_value, field.min, field.max);
    field.logarithmic = false;
  }
  return field;
}

// The mean value of the affected springs, or `value_without` if there are none.
void spring_row(const Parameter& row, double value_without, const CommonValue& common, const AffectedParts& parts, const PanelInput& input,
                Panels& panels, Requests& requests) {
  NumberField field = field_of(row, input.status.document->controls, common.value_or(value_without));
  field.mixed = common.is_mixed();
  field.enabled = !common.is_empty();
  const auto value = number_row(field, panels);
  if (!value) return;
  if (parts.springs.empty()) return edit(SetParameter{&row, *value}, panels, requests);
  const bool stiffness = row.scope == Parameter::Scope::SpringStiffness;
  SetSpringProperty set{stiffness ? SpringProperty::Stiffness : SpringProperty::Damping, {}};
  for_each_affected(*input.status.snapshot->system, parts, [&](const Spring& spring) {
    if (const double weight = weight_of(row, input.status.document->sheet.get(), spring); weight > 0.0)
      set.values.emplace_back(spring.id, weight * *value);
  });
  edit(std::move(set), panels, requests);
}

void switch_row(const Parameter& row, double value, Panels& panels, Requests& requests) {
  begin_row(std::string(row.label));
  bool on = value != 0.0;
  if (ImGui::Checkbox("##switch", &on)) edit(SetParameter{&row, on ? 1.0 : 0.0}, panels, requests);
  tooltip(std::string(row.description));
}

void choice_row(const Parameter& row, double value, Panels& panels, Requests& requests) {
  const auto now = static_cast<std::size_t>(value);
  begin_row(std::string(row.label));
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::BeginCombo("##choice", row.choices[now].label.data())) {
    for (std::size_t i = 0; i < row.choices.size(); ++i) {
      const bool chosen = ImGui::Selectable(row.choices[i].label.data(), i == now);
      tooltip(std::string(row.choices[i].description));
      if (chosen && i != now) edit(SetParameter{&row, static_cast<double>(i)}, panels, requests);
    }
    ImGui::EndCombo();
  } else {
    tooltip(std::string(row.choices[now].description));
  }
}

void method_row(const PanelInput& input, Panels& panels, Requests& requests) {
  const Integrator& now = *input.status.snapshot->settings.integrator;
  begin_row("Method");
  ImGui::SetNextItemWidth(-1.0f);
  // other names of the method appear only in the list
  const std::string name(now.label.substr(0, now.label.find(" (")));
  if (ImGui::BeginCombo("##method", name.c_str(), ImGuiComboFlags_HeightLarge)) {
    for (const Integrator& method : integrators()) {
      if (ImGui::Selectable(method.label.data(), &method == &now) && &method != &now) edit(SetIntegrator{&method}, panels, requests);
      tooltip(std::string(method.summary));
    }
    ImGui::EndCombo();
  } else {
    tooltip(std::string(now.summary));
  }
  build_accuracy_line(input, panels);
}

void parameter_row(const Parameter& row, double value, const PanelInput& input, Panels& panels, Requests& requests) {
  if (sets_springs(row)) {
    const AffectedParts& parts = panels.affected_parts.of(input.status, input.selection);
    const CommonValue& common = parts.slider_values[static_cast<std::size_t>(&row - parameters().data())];
    spring_row(row, value, common, parts, input, panels, requests);
  } else if (row.kind == Parameter::Kind::Switch) {
    switch_row(row, value, panels, requests);
  } else if (row.kind == Parameter::Kind::Choice) {
    choice_row(row, value, panels, requests);
  } else {
    NumberField field = field_of(row, input.status.document->controls, value);
    if (row.scope == Parameter::Scope::Colliders) {
      const auto& colliders = input.status.snapshot->system->colliders;
      const auto property = &row == &friction_parameter ? &Collider::friction : &Collider::restitution;
      field.enabled = std::ranges::any_of(colliders, &Collider::solid);
      field.mixed = std::ranges::any_of(colliders, [&](const Collider& each) { return each.*property != value; });
    }
    if (const auto changed = number_row(field, panels)) edit(SetParameter{&row, *changed}, panels, requests);
  }
}

// The remark on the right of the heading of a section.
std::string scope_of(std::string_view group, const PanelInput& input, Panels& panels) {
  if (group != "Springs") return {};
  const std::size_t selected = panels.affected_parts.of(input.status, input.selection).springs.size();
  return selected > 0 ? std::to_string(selected) + " selected" : "all " + std::to_string(input.status.snapshot->system->springs().size());
}

}  // namespace

void build_parameters(const PanelInput& input, Panels& panels, Requests& requests) {
  std::string_view group;
  bool open = false;
  const auto rows = parameters();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Parameter& row = rows[i];
    if (row.group != group) {
      group = row.group;
      open = section(std::string(group), scope_of(group, input, panels), group != "Hand" && group != "Points");
      if (open && group == "Simulation") method_row(input, panels, requests);
    }
    if (!open || std::isnan(input.status.document->parameter_values[i])) continue;
    ImGui::PushID(row.name.data());
    parameter_row(row, input.status.document->parameter_values[i], input, panels, requests);
    ImGui::PopID();
    parameter_hint_row(row, input);
  }
}

}  // namespace hooke
