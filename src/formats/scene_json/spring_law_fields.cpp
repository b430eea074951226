#include "formats/scene_json/spring_law_fields.h"

#include <array>
#include <cmath>
#include <optional>

#include "base/text_lines.h"
#include "formats/scene_json/scene_fields.h"
#include "scene/spring_laws.h"

namespace hooke {
namespace {

SpringForce read_force(const JsonField& field) {
  for (std::size_t i = 0; i < spring_forces.size(); ++i)
    if (field.text() == spring_forces[i].id) return static_cast<SpringForce>(i);
  field.refuse("must be " + joined(
                                spring_forces, [](const ParameterChoice& row) { return to_json(row.id); }, " or "));
}

void read_muscle(const JsonField& field, SpringLaw& law) {
  for (const JsonField member : field.members()) {
    if (member.is("amplitude"))
      law.amplitude = member.number({.min = -1.0, .max = 1.0});
    else if (member.is("frequency"))
      law.frequency = member.number(not_negative);
    else if (member.is("phase"))
      law.phase = member.number();
    else
      member.refuse("must be amplitude, frequency or phase");
  }
  required(field, "amplitude", "must be a number from -1 to 1");
}

}  // namespace

bool read_law_field(const JsonField& member, Spring& spring) {
  SpringLaw law = spring.law.value_or(SpringLaw{});
  if (member.is("law")) {
    law.force = read_force(member);
  } else if (member.is("k3")) {
    law.k3 = member.number();
  } else if (member.is("muscle")) {
    read_muscle(member, law);
  } else if (member.is("rest_length_rate")) {
    law.rate = member.number();
  } else if (member.is("rest_length_limits")) {
    const auto limits = member.items(2, 2);
    law.min_rest_length = limits[0].number(not_negative);
    law.max_rest_length = limits[1].is_null() ? SpringLaw{}.max_rest_length : limits[1].number({.min = law.min_rest_length});
  } else {
    return false;
  }
  spring.law = law == SpringLaw{} ? std::nullopt : std::optional(law);
  return true;
}

void write_law(const SpringLaw& law, JsonWriter& out) {
  if (law.force != SpringForce::Linear) out.text("law", spring_forces[static_cast<std::size_t>(law.force)].id);
  if (law.k3 != 0.0) out.number("k3", law.k3);
  if (law.amplitude != 0.0 || law.frequency != SpringLaw{}.frequency || law.phase != 0.0) {
    out.begin_object("muscle", JsonWriter::Layout::Line);
    out.number("amplitude", law.amplitude);
    out.number("frequency", law.frequency);
    out.number("phase", law.phase);
    out.end();
  }
  if (law.rate != 0.0) out.number("rest_length_rate", law.rate);
  if (!std::isfinite(law.max_rest_length) && law.min_rest_length == 0.0) return;
  const std::array<std::optional<double>, 2> limits{law.min_rest_length, law.max_rest_length};
  out.list("rest_length_limits", JsonWriter::Layout::Line, limits, [&](const std::optional<double>& limit) { out.number(limit); });
}

}  // namespace hooke
