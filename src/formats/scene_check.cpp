#include "formats/scene_check.h"

#include <limits>

#include "base/file_limits.h"
#include "base/json_text.h"
#include "base/text_lines.h"
#include "scene/quantity.h"
#include "sim/methods/integrator.h"

namespace hooke {
namespace {

const CriterionKind& read_kind(const JsonField& field) {
  for (const CriterionKind& kind : law_kinds())
    if (field.text() == kind.id) return kind;
  field.refuse("must be one of " + joined(law_kinds(), &CriterionKind::id));
}

Criterion read_criterion(const JsonField& field) {
  Criterion criterion;
  for (const JsonField member : field.members()) {
    if (member.is("law"))
      criterion.kind = &read_kind(member);
    else if (member.is("of"))
      criterion.of = member.text();
    else if (member.is("value"))
      criterion.value = member.number();
    else if (member.is("within"))
      criterion.within = member.number(not_negative);
    else if (member.is("least"))
      criterion.min = member.number();
    else if (member.is("most"))
      criterion.max = member.number();
    else if (member.is("from"))
      criterion.from = member.number(not_negative);
    else
      member.refuse("must be law, of, value, within, least, most or from");
  }
  if (criterion.kind == nullptr) field.refuse_missing("law", "must be given");
  // any point or spring, because their number is not known yet
  constexpr Index many = std::numeric_limits<Index>::max();
  const std::optional<Quantity> quantity = find_quantity(criterion.of, many, many);
  // a check measures the states alone
  if (!quantity || quantity->row->needs_accuracy) field.refuse("must have \"of\", one of " + quantity_names(false));
  if (criterion.kind->has_limits ? !criterion.min && !criterion.max : !criterion.within)
    field.refuse(criterion.kind->has_limits ? "must have least or most" : "must have within");
  if (criterion.kind->has_value && !criterion.value) field.refuse_missing("value", "must be a number");
  return criterion;
}

// "velocity_verlet", or {"method": "baraff_witkin", "substeps": 2}
CheckedMethod read_method(const JsonField& field) {
  CheckedMethod checked;
  const auto set_id = [&](const JsonField& id) {
    checked.method = find_integrator(id.text());
    if (checked.method == nullptr) id.refuse("must be the id of a method");
  };
  if (!field.is_object()) {
    set_id(field);
    return checked;
  }
  for (const JsonField member : field.members()) {
    if (member.is("method"))
      set_id(member);
    else if (member.is("substeps"))
      checked.substeps = static_cast<int>(member.integer(1, max_substeps));
    else
      member.refuse("must be method or substeps");
  }
  if (checked.method == nullptr) field.refuse_missing("method", "must be the id of a method");
  return checked;
}

}  // namespace

SceneCheck read_scene_check(const JsonField& field) {
  constexpr std::size_t max_criteria = 100;
  SceneCheck check;
  for (const JsonField member : field.members()) {
    if (member.is("seconds"))
      check.seconds = member.number({.min = 0.0, .max = 1e4});
    else if (member.is("stops"))
      check.expects_divergence = member.boolean();
    else if (member.is("methods"))
      for (const JsonField item : member.items(0, max_criteria)) check.methods.push_back(read_method(item));
    else if (member.is("laws"))
      for (const JsonField item : member.items(0, max_criteria)) check.criteria.push_back(read_criterion(item));
    else
      member.refuse("must be seconds, methods, laws or stops");
  }
  return check;
}

SceneCheck check_of(const Scene& scene) {
  SceneCheck check;
  if (!scene.preserved_json.check.empty()) {
    JsonParser parser;
    const std::string name = "check";
    check = read_scene_check({name, name, parser.parse(scene.preserved_json.check)});
  }
  if (check.methods.empty()) check.methods.push_back({scene.settings.integrator, std::nullopt});
  return check;
}

}  // namespace hooke
