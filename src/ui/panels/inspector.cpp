// The selection and its properties, which can be edited for one item or for all.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/typed_field.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

void edit(Command command, Panels& panels, Requests& requests) {
  requests.emplace_back(Edit{std::move(command), panels.field.edit_in_progress});
}

struct Inspected {
  const Snapshot& snapshot;
  const AffectedParts& parts;

  const Point& point(Index i) const { return snapshot.system->points()[i]; }
  Spring spring(Index s) const { return snapshot.system->springs()[s]; }
};

// Fills in the common value of all items, or their mean, and marks the field as mixed.
TypedField field_of(TypedField field, const Common<double>& now) {
  field.value = now.value;
  field.mixed = now.mixed;
  return field;
}

void point_row(const TypedField& field, PointProperty property, const Common<double>& now, const Inspected& inspected, Panels& panels,
               Requests& requests) {
  if (const auto value = typed_row(field_of(field, now), panels)) {
    SetPointProperty set{property, {}};
    for (const Index i : inspected.parts.points) set.values.emplace_back(inspected.point(i).id, *value);
    edit(std::move(set), panels, requests);
  }
}

void place_row(const char* label, int axis, const Inspected& inspected, Panels& panels, Requests& requests) {
  const State& state = inspected.snapshot.state;
  const auto now = common(inspected.parts.points, [&](Index i) { return state.position[i][axis]; });
  const TypedField field{.label = label,
                         .unit = "m",
                         .description = "A point that is moved keeps its velocity.",
                         .min = -typed::max_length,
                         .max = typed::max_length};
  if (const auto value = typed_row(field_of(field, now), panels)) {
    Move move;
    for (const Index i : inspected.parts.points) {
      Vec3 position = state.position[i];
      position[axis] = *value;
      move.items.push_back({inspected.point(i).id, position, state.velocity[i]});
    }
    edit(std::move(move), panels, requests);
  }
}

// Of the free points among the selected ones.
void velocity_row(const char* label, int axis, const Inspected& inspected, Panels& panels, Requests& requests) {
  const State& state = inspected.snapshot.state;
  std::vector<Index> free;
  std::ranges::copy_if(inspected.parts.points, std::back_inserter(free), [&](Index i) { return !inspected.point(i).nailed; });
  const auto now = common(free, [&](Index i) { return state.velocity[i][axis]; });
  const TypedField field{.label = label,
                         .unit = "m/s",
                         .description = "Alt+drag from a point in the scene sets it too.",
                         .min = -typed::max_speed,
                         .max = typed::max_speed};
  // kept where all are nailed, so that rows stay in place
  ImGui::BeginDisabled(free.empty());
  const auto value = typed_row(field_of(field, now), panels);
  ImGui::EndDisabled();
  if (!value || free.empty()) return;
  SetVelocity set;
  for (const Index i : free) {
    Vec3 velocity = state.velocity[i];
    velocity[axis] = *value;
    set.values.emplace_back(inspected.point(i).id, velocity);
  }
  edit(std::move(set), panels, requests);
}

void nailed_row(const Inspected& inspected, Panels& panels, Requests& requests) {
  const Common<bool>& now = inspected.parts.nailed;
  begin_row("Nailed");
  // one of two bits set shows the checkbox as mixed
  int bits = now.mixed ? 1 : now.value ? 3 : 0;
  if (!ImGui::CheckboxFlags("##nailed", &bits, 3)) return;
  SetNailed set;
  for (const Index i : inspected.parts.points)
    if (inspected.point(i).nailed != (bits == 3)) set.items.push_back({inspected.point(i).id, bits == 3});
  edit(std::move(set), panels, requests);
}

void color_row(const Inspected& inspected, Panels& panels, Requests& requests) {
  const Common<std::optional<Color>>& now = inspected.parts.color;
  const auto set_all = [&](std::optional<Color> color) {
    SetPointColor set;
    for (const Index i : inspected.parts.points) set.values.emplace_back(inspected.point(i).id, color);
    edit(std::move(set), panels, requests);
    panels.field.edit_in_progress = true;
  };
  begin_row("Color");
  const Color color = now.value.value_or(Color{200, 205, 212});
  float channels[] = {color.red / 255.0f, color.green / 255.0f, color.blue / 255.0f};
  if (ImGui::ColorEdit3("##color", channels, ImGuiColorEditFlags_NoInputs)) {
    const auto byte = [](float fraction) { return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(fraction, 0.0f, 1.0f))); };
    set_all(Color{byte(channels[0]), byte(channels[1]), byte(channels[2])});
  }
  const Common<bool>& nailed = inspected.parts.nailed;
  tooltip(nailed.value && !nailed.mixed ? "Nails are yellow; this is the color of the points when they are released."
                                        : "Color of the points");
  ImGui::SameLine();
  if (now.mixed) {
    dim_text("varies");
    ImGui::SameLine();
  } else if (!now.value) {
    return dim_text("by state");
  }
  if (ImGui::SmallButton("By state")) set_all(std::nullopt);
}

void point_rows(const Inspected& inspected, Panels& panels, Requests& requests) {
  ImGui::PushID("points");
  const char* names[] = {"Position x", "Position y", "Position z"};
  for (int axis = 0; axis < inspected.snapshot.system->dimensions; ++axis) {
    ImGui::PushID(axis);
    place_row(names[axis], axis, inspected, panels, requests);
    ImGui::PopID();
  }
  const char* velocities[] = {"Velocity x", "Velocity y", "Velocity z"};
  for (int axis = 0; axis < inspected.snapshot.system->dimensions; ++axis) {
    ImGui::PushID(velocities[axis]);
    velocity_row(velocities[axis], axis, inspected, panels, requests);
    ImGui::PopID();
  }
  ImGui::PushID("mass");
  point_row({.label = "Mass", .unit = "kg", .description = "Mass of each selected point.", .min = typed::min_mass, .max = typed::max_mass},
            PointProperty::Mass, inspected.parts.mass, inspected, panels, requests);
  ImGui::PopID();
  ImGui::PushID("radius");
  point_row({.label = "Radius",
             .unit = "m",
             .description = "Radius of the drawn ball; also its contact distance.",
             .min = 0.0,
             .max = typed::max_length},
            PointProperty::Radius, inspected.parts.radius, inspected, panels, requests);
  ImGui::PopID();
  nailed_row(inspected, panels, requests);
  color_row(inspected, panels, requests);
  ImGui::PopID();
}

// The current length of a single spring.
void length_line(const Inspected& inspected) {
  const Spring spring = inspected.spring(inspected.parts.springs[0]);
  const double length = glm::distance(inspected.snapshot.position(spring.first), inspected.snapshot.position(spring.second));
  begin_row("Current length");
  std::string text = quantity_text(length, "m");
  const double rest_length = inspected.snapshot.system->rest_length_of(spring, inspected.snapshot.state.time);
  if (rest_length > 0.0) text += ", strain " + number_text(100.0 * (length / rest_length - 1.0)) + " %";
  ImGui::TextUnformatted(text.c_str());
}

struct SpringRow {
  TypedField field;
  SpringProperty property;
  Common<double> AffectedParts::*now;
};
constexpr SpringRow spring_table[] = {
    {{.label = "Stiffness k", .unit = "N/m", .description = "Force per unit of elongation.", .max = typed::max_stiffness},
     SpringProperty::Stiffness,
     &AffectedParts::stiffness},
    {{.label = "Damping d",
      .unit = "N s/m",
      .description = "Force along the spring per unit of the relative velocity of its ends.",
      .max = typed::max_damping},
     SpringProperty::Damping,
     &AffectedParts::damping},
    {{.label = "Rest length", .unit = "m", .description = "Length at which the spring exerts no force.", .max = typed::max_length},
     SpringProperty::RestLength,
     &AffectedParts::rest_length},
    {{.label = "Breaks at",
      .description = "Strain at which the spring breaks: 0.5 means 50 % longer than its rest length. \"never\" disables breaking.",
      .min = 1e-6,
      .max = typed::max_strain,
      .infinity_text = "never"},
     SpringProperty::BreakStrain,
     &AffectedParts::break_strain},
};

void spring_rows(const Inspected& inspected, Panels& panels, Requests& requests) {
  ImGui::PushID("springs");
  for (const SpringRow& row : spring_table) {
    ImGui::PushID(row.field.label.data());
    if (const auto value = typed_row(field_of(row.field, inspected.parts.*row.now), panels)) {
      SetSpringProperty set{row.property, {}};
      for (const Index s : inspected.parts.springs) set.values.emplace_back(inspected.spring(s).id, *value);
      edit(std::move(set), panels, requests);
    }
    ImGui::PopID();
  }
  if (inspected.parts.springs.size() == 1) length_line(inspected);
  ImGui::PopID();
}

}  // namespace

void build_inspector(const PanelInput& input, Panels& panels, Requests& requests) {
  if (input.selection.collider) return build_collider(input, panels, requests);
  if (input.selection.empty()) return;
  const Inspected inspected{*input.status.snapshot, panels.side.affected_parts.of(input.status, input.selection)};
  const auto points = static_cast<long>(inspected.parts.points.size()), springs = static_cast<long>(inspected.parts.springs.size());
  std::string what = points > 0 ? count(points, "point") : "";
  if (springs > 0) what += (what.empty() ? "" : ", ") + count(springs, "spring");
  if (!section("Selection", what)) return;
  if (points > 0) point_rows(inspected, panels, requests);
  if (springs > 0) spring_rows(inspected, panels, requests);
  if (springs > 0) build_spring_law(input, inspected.parts.springs, panels, requests);
  if (springs > 0) build_stretch(input, requests);
  build_arrange(input, panels, requests);
}

}  // namespace hooke
