// The selection and its properties, which can be edited for one item or for all.
#include <algorithm>
#include <array>
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

// A row for each component of a vector of these points: `read` of a point; `add` puts a new one into the command.
template <class Set, class Read, class Add>
void vector_rows(const std::array<const char*, 3>& labels, TypedField field, const std::vector<Index>& points, const Inspected& inspected,
                 Panels& panels, Requests& requests, const Read& read, const Add& add) {
  for (int axis = 0; axis < inspected.snapshot.system->dimensions; ++axis) {
    field.label = labels[static_cast<std::size_t>(axis)];
    field.min = -field.max;
    ImGui::PushID(field.label.data());
    // kept where there are no such points, so that rows stay in place
    ImGui::BeginDisabled(points.empty());
    const auto value = typed_row(field_of(field, common(points, [&](Index i) { return read(i)[axis]; })), panels);
    ImGui::EndDisabled();
    ImGui::PopID();
    if (!value || points.empty()) continue;
    Set set;
    for (const Index i : points) {
      Vec3 vector = read(i);
      vector[axis] = *value;
      add(set, inspected.point(i).id, i, vector);
    }
    edit(std::move(set), panels, requests);
  }
}

void all_vector_rows(const Inspected& inspected, Panels& panels, Requests& requests) {
  const State& state = inspected.snapshot.state;
  const std::vector<Index>& points = inspected.parts.points;
  vector_rows<Move>(
      {"Position x", "Position y", "Position z"},
      {.unit = "m", .description = "A point that is moved keeps its velocity.", .max = typed::max_length}, points, inspected, panels,
      requests, [&](Index i) { return state.position[i]; },
      [&](Move& set, PointId id, Index i, const Vec3& position) {
        set.items.push_back({id, position, state.velocity[i]});
      });
  std::vector<Index> free;
  std::ranges::copy_if(points, std::back_inserter(free), [&](Index i) { return !inspected.point(i).nailed; });
  vector_rows<SetVelocity>(
      {"Velocity x", "Velocity y", "Velocity z"},
      {.unit = "m/s", .description = "Alt+drag from a point in the scene sets it too.", .max = typed::max_speed}, free, inspected, panels,
      requests, [&](Index i) { return state.velocity[i]; },
      [](SetVelocity& set, PointId id, Index, const Vec3& velocity) { set.values.emplace_back(id, velocity); });
  vector_rows<SetLoad>(
      {"Load x", "Load y", "Load z"}, {.unit = "N", .description = "A constant force on each selected point.", .max = typed::max_force},
      points, inspected, panels, requests, [&](Index i) { return inspected.point(i).load; },
      [](SetLoad& set, PointId id, Index, const Vec3& load) { set.values.emplace_back(id, load); });
}

void fixed_row(const Inspected& inspected, Panels& panels, Requests& requests) {
  begin_row("Fixed along");
  const char* names[] = {"x", "y", "z"};
  for (int axis = 0; axis < inspected.snapshot.system->dimensions; ++axis) {
    const auto now = common(inspected.parts.points, [&](Index i) { return inspected.point(i).is_fixed_along(axis); });
    int bits = now.mixed ? 1 : now.value ? 3 : 0;
    if (axis > 0) ImGui::SameLine();
    const bool is_changed = ImGui::CheckboxFlags(names[axis], &bits, 3);
    tooltip("A roller: the points do not move along this axis. What touches them does not push them");
    if (!is_changed) continue;
    SetFixedAxes set;
    for (const Index i : inspected.parts.points) {
      const int others = inspected.point(i).fixed_axes & ~(1 << axis);
      set.values.emplace_back(inspected.point(i).id, static_cast<std::uint8_t>(others | (bits == 3 ? 1 << axis : 0)));
    }
    edit(std::move(set), panels, requests);
  }
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
  all_vector_rows(inspected, panels, requests);
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
  fixed_row(inspected, panels, requests);
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
