// The law of the selected springs: force, muscle and winch.
#include "scene/spring_laws.h"

#include <algorithm>

#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/typed_field.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

struct LawNumber {
  TypedField field;
  double SpringLaw::*member;
  bool of_cubic = false;  // only with the cubic force
};
constexpr double any = 1e12;
const LawNumber numbers[] = {
    {{.label = "Cubic k3",
      .unit = "N/m^3",
      .description = "Force per elongation cubed; negative: the spring softens.",
      .min = -any,
      .max = any},
     &SpringLaw::k3,
     true},
    {{.label = "Muscle", .description = "Amplitude of the rest length, relative to it; 0: no muscle.", .min = -1.0, .max = 1.0},
     &SpringLaw::amplitude},
    {{.label = "Frequency", .unit = "1/s", .description = "Frequency of the muscle.", .max = 1e6}, &SpringLaw::frequency},
    {{.label = "Phase", .unit = "rad", .description = "Phase of the muscle.", .min = -1e6, .max = 1e6}, &SpringLaw::phase},
    {{.label = "Winch", .unit = "m/s", .description = "Rate of the rest length; 0: no winch.", .min = -1e6, .max = 1e6}, &SpringLaw::rate},
    {{.label = "Shortest", .unit = "m", .description = "Minimum rest length.", .max = 1e6}, &SpringLaw::min_rest_length},
    {{.label = "Longest", .unit = "m", .description = "Maximum rest length.", .max = 1e6, .infinity_text = "none"},
     &SpringLaw::max_rest_length},
};

}  // namespace

void build_spring_law(const PanelInput& input, const std::vector<Index>& springs, Panels& panels, Requests& requests) {
  const SpringList& list = input.status.snapshot->system->springs();
  const auto law_of = [&](Index s) { return list[s].law.value_or(SpringLaw{}); };
  const auto set = [&](const auto& change) {
    SetSpringLaw command;
    for (const Index s : springs) {
      SpringLaw law = law_of(s);
      change(law);
      if (law.force != SpringForce::Cubic) law.k3 = 0.0;
      command.values.emplace_back(list[s].id, law == SpringLaw{} ? std::nullopt : std::optional(law));
    }
    requests.emplace_back(Edit{std::move(command), panels.field.edit_in_progress});
  };

  const Common<SpringForce> force = common(springs, [&](Index s) { return law_of(s).force; });
  const ParameterChoice& now = spring_forces[static_cast<std::size_t>(force.value)];
  begin_row("Law");
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::BeginCombo("##law", force.mixed ? "varies" : now.label.data())) {
    close_on_escape(input, panels);
    for (std::size_t i = 0; i < spring_forces.size(); ++i) {
      const bool is_now = !force.mixed && &spring_forces[i] == &now;
      if (ImGui::Selectable(spring_forces[i].label.data(), is_now) && !is_now)
        set([&](SpringLaw& law) { law.force = static_cast<SpringForce>(i); });
      tooltip(std::string(spring_forces[i].description));
    }
    ImGui::EndCombo();
  } else {
    tooltip(std::string(now.description));
  }

  const bool moves = std::ranges::any_of(springs, [&](Index s) { return law_of(s).amplitude != 0.0; });
  const bool winds = std::ranges::any_of(springs, [&](Index s) { return law_of(s).rate != 0.0; });
  for (const LawNumber& row : numbers) {
    const bool is_of_muscle = row.member == &SpringLaw::frequency || row.member == &SpringLaw::phase;
    const bool is_of_winch = row.member == &SpringLaw::min_rest_length || row.member == &SpringLaw::max_rest_length;
    if ((row.of_cubic && (force.mixed || force.value != SpringForce::Cubic)) || (is_of_muscle && !moves) || (is_of_winch && !winds))
      continue;
    ImGui::PushID(row.field.label.data());
    TypedField field = row.field;
    const Common<double> value = common(springs, [&](Index s) { return law_of(s).*row.member; });
    field.value = value.value;
    field.mixed = value.mixed;
    if (const auto typed = typed_row(field, panels)) set([&](SpringLaw& law) { law.*row.member = *typed; });
    ImGui::PopID();
  }
}

}  // namespace hooke
