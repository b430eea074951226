// Sliders and switches, made from the rows of the parameter table, with their effect on the current scene.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/number_text.h"
#include "scene/flatness.h"
#include "scene/parameter_groups.h"
#include "scene/parameters.h"
#include "sim/control/automatic.h"
#include "sim/methods/integrator.h"
#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/panels/mixed_values.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

void edit_by_drag(Command command, Panels& panels, Requests& requests) {
  requests.emplace_back(Edit{std::move(command), panels.field.edit_in_progress});
  panels.field.edit_in_progress = true;
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
                    .logarithmic = row.logarithmic,
                    .zero_text = row.zero_text,
                    .typed = allowed_range(row)};
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

// Sets equal values; scales different ones, if the slider is dragged. A drag always scales the values at its start, so that none is lost
// at the end of the slider.
void change(const Parameter& row, const NumberChange& change, const CommonValue& values, const AffectedSprings& affected,
            const PanelInput& input, Panels& panels, Requests& requests) {
  const auto& now = input.status.snapshot->system;
  const SheetWeights* sheet = input.status.document->sheet.get();
  const bool continues = panels.field.edit_in_progress && panels.field.tuned_from != nullptr;
  const bool scales = change.is_drag && (continues || values.is_mixed());
  if (scales) {
    if (!continues) panels.field.tuned_from = now;
    if (auto scaled = scaled_values(row, *panels.field.tuned_from, *now, sheet, affected, change.value))
      return edit_by_drag(*std::move(scaled), panels, requests);
  }
  const bool is_stiffness = row.scope == Parameter::Scope::SpringStiffness, is_damping = row.scope == Parameter::Scope::SpringDamping;
  if (affected.all || (!is_stiffness && !is_damping)) return edit_by_drag(SetParameter{&row, change.value}, panels, requests);
  SetSpringProperty set{is_stiffness ? SpringProperty::Stiffness : SpringProperty::Damping, {}};
  for (const SpringId id : affected.selected)
    if (const Index s = now->index_of(id); s != no_index)
      if (const double weight = weight_of(row, sheet, now->springs()[s]); weight > 0.0) set.values.emplace_back(id, weight * change.value);
  edit_by_drag(std::move(set), panels, requests);
}

// A number of the scene, or one that many springs, points or colliders have; the mean where they differ.
void value_row(const Parameter& row, double value, const AffectedParts& parts, const PanelInput& input, Panels& panels,
               Requests& requests) {
  const CommonValue& values = parts.slider_values[static_cast<std::size_t>(&row - parameters().data())];
  NumberField field = field_of(row, input.status.document->controls, values.value_or(value));
  field.mixed = values.is_mixed();
  field.enabled = !values.is_empty() || !has_many_values(row);
  if (const auto changed = changed_row(field, panels)) change(row, *changed, values, parts.slider_springs, input, panels, requests);
}

void switch_row(const Parameter& row, double value, Panels& panels, Requests& requests) {
  begin_row(std::string(row.label));
  bool on = value != 0.0;
  if (ImGui::Checkbox("##switch", &on)) edit_by_drag(SetParameter{&row, on ? 1.0 : 0.0}, panels, requests);
  tooltip(std::string(row.description));
}

// Why a choice is not available; empty if it is.
std::string reason_against(const Parameter& row, std::size_t choice, const PanelInput& input) {
  if (&row != &dimensions_parameter || choice != 0) return {};
  const std::string reason = why_not_flat(*input.status.snapshot->system, input.status.snapshot->state);
  return reason.empty() ? "" : "Not possible: " + reason;
}

void choice_row(const Parameter& row, double value, const PanelInput& input, Panels& panels, Requests& requests) {
  const auto now = static_cast<std::size_t>(value);
  begin_row(std::string(row.label));
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::BeginCombo("##choice", row.choices[now].label.data())) {
    close_on_escape(input, panels);
    for (std::size_t i = 0; i < row.choices.size(); ++i) {
      const std::string reason = i == now ? "" : reason_against(row, i, input);
      const ImGuiSelectableFlags flags = reason.empty() ? 0 : ImGuiSelectableFlags_Disabled;
      const bool chosen = ImGui::Selectable(row.choices[i].label.data(), i == now, flags);
      tooltip(reason.empty() ? std::string(row.choices[i].description) : reason);
      if (chosen && i != now) edit_by_drag(SetParameter{&row, static_cast<double>(i)}, panels, requests);
    }
    ImGui::EndCombo();
  } else {
    tooltip(std::string(row.choices[now].description));
  }
}

void device_row(const PanelInput& input, Panels& panels, Requests& requests) {
  const RunStatus& run = input.status.run;
  begin_row("Compute on");
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::BeginCombo("##device", run.on_device ? "GPU" : "CPU")) {
    close_on_escape(input, panels);
    for (const bool on_device : {false, true})
      if (ImGui::Selectable(on_device ? "GPU" : "CPU", on_device == run.on_device) && on_device != run.on_device)
        requests.emplace_back(Action::SwitchDevice);
    ImGui::EndCombo();
  }
  if (run.device_refusal.empty()) return;
  ImGui::PushFont(fonts().small);
  begin_row("");
  paragraph("Computed on the CPU: " + run.device_refusal, palette::warning);
  ImGui::PopFont();
}

void method_row(const PanelInput& input, Panels& panels, Requests& requests) {
  const Integrator& now = *input.status.snapshot->settings.integrator;
  begin_row("Method");
  ImGui::SetNextItemWidth(-1.0f);
  // other names of the method appear only in the list
  const std::string name = now.short_name();
  if (ImGui::BeginCombo("##method", name.c_str(), ImGuiComboFlags_HeightLarge)) {
    close_on_escape(input, panels);
    const auto entry = [&](const Integrator& method) {
      if (ImGui::Selectable(method.label.data(), &method == &now) && &method != &now)
        edit_by_drag(SetIntegrator{&method}, panels, requests);
      tooltip(std::string(method.summary));
    };
    entry(automatic_method());
    for (const Integrator& method : integrators()) entry(method);
    ImGui::EndCombo();
  } else {
    tooltip(std::string(now.summary));
  }
  if (const auto& choice = input.status.snapshot->state.memory.choice; choice && is_automatic(input.status.snapshot->settings)) {
    ImGui::PushFont(fonts().small);
    begin_row("Chosen");
    const Settings& settings = input.status.snapshot->settings;
    paragraph(describe(*choice, settings), is_tolerance_met(*choice, settings) ? palette::dim : palette::warning);
    ImGui::PopFont();
  }
  device_row(input, panels, requests);
  build_accuracy_line(input, panels);
}

void parameter_row(const Parameter& row, double value, const AffectedParts& parts, const PanelInput& input, Panels& panels,
                   Requests& requests) {
  if (row.kind == Parameter::Kind::Switch)
    switch_row(row, value, panels, requests);
  else if (row.kind == Parameter::Kind::Choice)
    choice_row(row, value, input, panels, requests);
  else
    value_row(row, value, parts, input, panels, requests);
}

// The remark at the right of a section's heading.
std::string scope_of(std::string_view group, const AffectedSprings& affected, const System& system) {
  if (group != parameter_group::springs) return {};
  return affected.all ? "all " + number_text(system.spring_count())
                      : number_text(static_cast<double>(affected.selected.size())) + " selected";
}

}  // namespace

void build_parameters(const PanelInput& input, Panels& panels, Requests& requests) {
  std::string_view group;
  bool open = false;
  const auto rows = parameters();
  const AffectedParts& parts = panels.side.affected_parts.of(input.status, input.selection);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Parameter& row = rows[i];
    if (row.group != group) {
      if (group == parameter_group::simulation && has_forces_first(input)) build_forces(input, panels, requests);
      group = row.group;
      const bool starts_open = group != parameter_group::hand && group != parameter_group::points && group != parameter_group::contact;
      open = section(std::string(group), scope_of(group, parts.slider_springs, *input.status.snapshot->system), starts_open);
      if (open && group == parameter_group::simulation) method_row(input, panels, requests);
    }
    if (!open || std::isnan(input.status.document->parameter_values[i])) continue;
    if (&row == &substeps_parameter && is_automatic(input.status.snapshot->settings)) continue;
    ImGui::PushID(row.name.data());
    parameter_row(row, input.status.document->parameter_values[i], parts, input, panels, requests);
    ImGui::PopID();
    parameter_hint_row(row, input);
  }
}

}  // namespace hooke
