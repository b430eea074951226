#include "formats/scene_json/scene_sections.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "base/file_limits.h"
#include "base/json_writer.h"
#include "base/option_error.h"
#include "base/text_lines.h"
#include "formats/texture.h"
#include "scene/parameter_value.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"

namespace hooke {
namespace {

CameraPose read_camera(const JsonField& field, SceneFields& fields, Scene& scene) {
  CameraPose pose;
  for (const JsonField member : field.members()) {
    if (member.is("eye"))
      pose.eye = fields.vector(member);
    else if (member.is("target"))
      pose.target = fields.vector(member);
    else if (member.is("up")) {
      pose.up = fields.vector(member);
      if (*pose.up == Vec3(0.0)) member.refuse("must not be zero");
    } else if (member.is("orthographic"))
      pose.orthographic = member.boolean();
    else if (member.is("follow"))
      pose.follows = member.boolean();
    else
      fields.preserve_unknown(member, scene.preserved_json.unknown_inside[field.path()]);
  }
  if (pose.eye == pose.target) field.refuse("must have different positions for eye and target");
  return pose;
}

// The switch of this name, or null.
bool* view_flag_of(const JsonField& field, ViewSettings& view) {
  if (field.is("surface")) return &view.surface;
  if (field.is("springs")) return &view.springs;
  if (field.is("points")) return &view.points;
  if (field.is("strain_colors")) return &view.strain_colors;
  if (field.is("shadows")) return &view.shadows;
  if (field.is("coils")) return &view.coils;
  return nullptr;
}

std::string ids_of_forces() { return joined(force_terms(), &ForceTerm::id); }

// The index of the choice with the id that the field names.
template <class Choice>
std::size_t read_choice(std::span<const Choice> choices, const JsonField& field) {
  for (std::size_t i = 0; i < choices.size(); ++i)
    if (field.text() == choices[i].id) return i;
  field.refuse("must be one of " + joined(choices, [](const Choice& choice) { return to_json(choice.id); }));
}

// Sets the parameter of this name, which may be outside the range of the slider. Returns false if the force has none of this name.
bool read_force_number(const JsonField& member, Force& force) {
  for (std::size_t i = 0; i < force.term->numbers.size(); ++i) {
    const ForceParameter& number = force.term->numbers[i];
    if (!member.is(number.name)) continue;
    force.values[i] = number.choices.empty() ? member.number(number.valid()) : static_cast<double>(read_choice(number.choices, member));
    return true;
  }
  return false;
}

// A smaller radius would make the angular velocity overflow.
constexpr double min_circle_radius = 1e-6;  // [m]

void read_circle(const JsonField& field, SceneFields& fields, Scene& scene, ScriptedHand& hand) {
  for (const JsonField member : field.members()) {
    if (member.is("from"))
      hand.from = fields.position(member);
    else if (member.is("center"))
      hand.center = fields.position(member);
    else if (member.is("axis"))
      hand.axis = fields.direction(member);
    else
      fields.preserve_unknown(member, scene.preserved_json.unknown_inside[field.path()]);
  }
  for (const char* key : {"from", "center"}) required(field, key, "must be [x, y, z]");
  const double radius = glm::length(glm::cross(hand.axis, hand.from - hand.center));
  if (!(radius >= min_circle_radius) || !std::isfinite(radius))
    field.refuse("must have from at least 1e-06 m away from the axis through center");
}

}  // namespace

bool read_parameter(const JsonField& field, Scene& scene) {
  for (const Parameter& row : parameters()) {
    if (row.field.empty() || row.field != field.path()) continue;
    switch (row.kind) {
      case Parameter::Kind::Switch:
        row.write(scene, field.boolean() ? 1.0 : 0.0);
        break;
      case Parameter::Kind::Integer:
        row.write(scene, static_cast<double>(
                             field.integer(static_cast<std::int64_t>(row.physical.min), static_cast<std::int64_t>(row.physical.max))));
        break;
      case Parameter::Kind::Choice:
        row.write(scene, static_cast<double>(read_choice(row.choices, field)));
        break;
      case Parameter::Kind::Number:
        row.write(scene, field.number(row.physical));
        break;
    }
    return true;
  }
  return false;
}

void read_force(const JsonField& field, SceneFields& fields, Scene& scene) {
  const JsonField type = required(field, "type", "must be one of " + ids_of_forces());
  Force force{.term = find_force_term(type.text())};
  if (force.term == nullptr) type.refuse(must_be_one_of(ids_of_forces(), type.text()));
  force.values = default_values(*force.term);
  for (const JsonField member : field.members()) {
    if (member.is("type")) continue;
    if (member.is("on"))
      force.on = member.boolean();
    else if (!read_force_number(member, force))
      fields.preserve_unknown(member, scene.preserved_json.unknown_inside[field.path()]);
  }
  scene.system.forces.push_back(force);
}

void read_contact(const JsonField& field, SceneFields& fields, Scene& scene) {
  for (const JsonField member : field.members()) {
    if (!read_parameter(member, scene)) fields.preserve_unknown(member, scene.preserved_json.unknown_inside[field.path()]);
  }
}

void read_hand(const JsonField& field, SceneFields& fields, Scene& scene) {
  ScriptedHand hand;
  for (const JsonField member : field.members()) {
    if (member.is("point"))
      hand.point = PointId{static_cast<std::uint32_t>(member.integer(0, static_cast<std::int64_t>(max_points) - 1))};
    else if (member.is("circle"))
      read_circle(member, fields, scene, hand);
    else if (member.is("speed"))
      hand.speed = member.number({.min = 0.0, .max = 1e6});
    else if (member.is("begin"))
      hand.begin = member.number();
    else if (member.is("seconds"))
      hand.seconds = member.number(positive);
    else
      fields.preserve_unknown(member, scene.preserved_json.unknown_inside[field.path()]);
  }
  required(field, "point", "must be a point number");
  required(field, "circle", "must be {\"from\": [x, y, z], \"center\": [x, y, z]}");
  required(field, "speed", "must be from 0 to 1000000");
  required(field, "seconds", "must be more than 0");
  scene.system.scripted_hand = hand;
}

void read_simulation(const JsonField& field, SceneFields& fields, Scene& scene) {
  for (const JsonField member : field.members()) {
    if (member.is("integrator")) {
      scene.settings.integrator = find_integrator(member.text());
      if (scene.settings.integrator == nullptr) member.refuse(must_be_one_of(ids_of_integrators(), member.text()));
    } else if (member.is("tolerance")) {
      if (!member.is_null()) scene.settings.tolerance = member.number(positive);
    } else if (!read_parameter(member, scene))
      fields.preserve_unknown(member, scene.preserved_json.unknown_inside[field.path()]);
  }
}

void read_view(const JsonField& field, SceneFields& fields, Scene& scene) {
  for (const JsonField member : field.members()) {
    if (member.is("camera"))
      scene.view.camera = read_camera(member, fields, scene);
    else if (member.is("background"))
      scene.view.background = fields.color(member);
    else if (bool* is_shown = view_flag_of(member, scene.view))
      *is_shown = member.boolean();
    else if (member.is("texture")) {
      scene.view.texture = member.text();
      if (const std::string limit = texture_limit(scene.view.texture); !limit.empty()) member.refuse(limit);
    } else if (member.is("plots")) {
      for (const JsonField name : member.items(0, 100)) scene.view.plots.emplace_back(name.text());
    } else if (member.is("texture_size"))
      scene.view.texture_size = member.number(positive);
    else
      fields.preserve_unknown(member, scene.preserved_json.unknown_inside[field.path()]);
  }
}

void read_defaults(const JsonField& field, SceneFields& fields, Scene& scene) {
  for (const JsonField member : field.members()) {
    if (member.is("radius"))
      scene.defaults.radius = member.number(not_negative);
    else if (member.is("grab")) {
      if (member.text() != "hold" && member.text() != "pull") member.refuse("must be \"hold\" or \"pull\"");
      scene.defaults.grab = member.text() == "hold" ? GrabKind::Hold : GrabKind::Pull;
    } else if (!read_parameter(member, scene))
      fields.preserve_unknown(member, scene.preserved_json.unknown_inside[field.path()]);
  }
}

void read_controls(const JsonField& field, SceneFields& fields, Scene& scene) {
  for (const JsonField member : field.members()) {
    if (!member.is("stiffness")) {
      fields.preserve_unknown(member, scene.preserved_json.unknown_inside[field.path()]);
      continue;
    }
    const auto items = member.items(3, 3);
    ControlRanges& controls = scene.controls;
    controls.stiffness_min = items[0].number(not_negative);
    controls.stiffness_max = items[1].number(positive);
    controls.stiffness_step = items[2].number(positive);
    if (!(controls.stiffness_min < controls.stiffness_max)) member.refuse("must be [min, max, step] with min below max");
  }
}

}  // namespace hooke
