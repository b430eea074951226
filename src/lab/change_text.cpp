#include "lab/change_text.h"

#include <array>
#include <cmath>

#include "base/number_text.h"
#include "base/overloaded.h"
#include "scene/parameters.h"
#include "sim/methods/integrator.h"

namespace hooke {
namespace {

template <class Items, class Value>
std::string mean_of(const Items& items, const Value& value) {
  double sum = 0.0, count = 0.0;
  for (const auto& item : items)
    if (const auto one = value(item.first); std::isfinite(one)) sum += one, count += 1.0;
  return count > 0.0 ? number_text(sum / count) : std::string();
}

std::string value_of(const Parameter& parameter, const Scene& scene) {
  const double value = parameter.read(scene);
  if (parameter.kind == Parameter::Kind::Switch) return value != 0.0 ? "on" : "off";
  if (parameter.kind == Parameter::Kind::Choice) {
    const auto choice = static_cast<std::size_t>(value);
    return choice < parameter.choices.size() ? std::string(parameter.choices[choice].label) : number_text(value);
  }
  return std::isfinite(value) ? number_text(value) : std::string();
}

// What is set, and in which unit: "k", "N/m".
struct Named {
  std::string name, unit;
};

Named quantity_of(const Command& command) {
  const auto of_parameter = [](const Parameter& parameter) {
    // "Stiffness k" is known as k
    const std::string label(parameter.label);
    const auto last = label.rfind(' ');
    const bool has_symbol = last != std::string::npos && label.size() - last == 2;
    return Named{has_symbol ? label.substr(last + 1) : label, unit_text(parameter.unit)};
  };
  return std::visit(Overloaded{
                        [&](const SetParameter& set) { return of_parameter(*set.parameter); },
                        [&](const RestoreParameter& set) { return of_parameter(*set.parameter); },
                        [](const SetIntegrator&) {
                          return Named{"method", ""};
                        },
                        [](const SetPointProperty& set) {
                          return set.property == PointProperty::Mass ? Named{"mass", "kg"} : Named{"radius", "m"};
                        },
                        [](const SetSpringProperty& set) {
                          constexpr std::array<std::pair<const char*, const char*>, 4> names{
                              {{"k", "N/m"}, {"d", "N s/m"}, {"rest length", "m"}, {"break strain", ""}}};
                          const auto& [name, unit] = names[static_cast<std::size_t>(set.property)];
                          return Named{name, unit};
                        },
                        [](const auto&) { return Named{}; },
                    },
                    command);
}

}  // namespace

bool can_cause_failure(const Command& command) {
  return std::visit(
      []<class T>(const T&) {
        return !is_one_of<T, SetPointColor, SetText, SetPlots, SetTexture, GoToState, SetTorn, MarkTorn, Replace, ReleaseHand>;
      },
      command);
}

std::string value_before(const Command& command, const Scene& scene) {
  const System& system = scene.system;
  return std::visit(Overloaded{
                        [&](const SetParameter& set) { return value_of(*set.parameter, scene); },
                        [&](const RestoreParameter& set) { return value_of(*set.parameter, scene); },
                        [&](const SetIntegrator&) { return scene.settings.integrator->short_name(); },
                        [&](const SetPointProperty& set) {
                          return mean_of(set.values, [&](PointId id) {
                            const Index i = system.index_of(id);
                            return i == no_index ? std::nan("") : system.points()[i].*member_of(set.property);
                          });
                        },
                        [&](const SetSpringProperty& set) {
                          return mean_of(set.values, [&](SpringId id) {
                            const Index s = system.index_of(id);
                            return s == no_index ? std::nan("") : system.springs()[s].*member_of(set.property);
                          });
                        },
                        [](const auto&) { return std::string(); },
                    },
                    command);
}

std::string change_text(const Command& command, const std::string& before, const Scene& scene) {
  const Named quantity = quantity_of(command);
  const std::string after = value_before(command, scene);
  if (quantity.name.empty() || before.empty() || after.empty()) return describe(command);
  return quantity.name + ": " + before + " \u2192 " + after + (quantity.unit.empty() ? "" : " " + quantity.unit);
}

}  // namespace hooke
