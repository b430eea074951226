// The numbers of a collider: of the selected one, and of one that is being placed.
#include "scene/collider_kinds.h"
#include "ui/number_field.h"
#include "ui/panels.h"
#include "ui/typed_field.h"
#include "ui/widgets.h"

namespace hooke {

std::optional<Collider> collider_rows(const Collider& collider, int dimensions, Panels& panels) {
  std::optional<Collider> changed;
  for (const ColliderNumber& row : collider_numbers()) {
    if (!row.applies(collider) || (row.is_3d_only && dimensions == 2)) continue;
    ImGui::PushID(row.label.data());
    // all that turns in a flat scene turns about z
    const std::string_view label = dimensions == 2 && row.label == "Spin z" ? "Spin" : row.label;
    const TypedField field{
        .label = label, .unit = row.unit, .description = row.description, .min = row.min, .max = row.max, .value = row.read(collider)};
    if (const auto value = typed_row(field, panels)) {
      changed = collider;
      row.write(*changed, *value);
    }
    ImGui::PopID();
  }
  begin_row("Solid");
  bool is_solid = collider.solid;
  if (ImGui::Checkbox("##solid", &is_solid)) {
    changed = collider;
    changed->solid = is_solid;
  }
  tooltip("Points touch it; otherwise it is only drawn");
  return changed;
}

void build_collider(const PanelInput& input, Panels& panels, Requests& requests) {
  const Snapshot& snapshot = *input.status.snapshot;
  const auto& selected = input.selection.collider;
  std::vector<Collider> colliders = carried_colliders(*snapshot.system, snapshot.state);
  if (!selected || *selected >= static_cast<Index>(colliders.size())) return;
  Collider& collider = colliders[static_cast<std::size_t>(*selected)];
  if (!section("Collider", std::string(kind_of(collider).label))) return;
  ImGui::PushID("collider");
  const auto changed = collider_rows(collider, snapshot.system->dimensions, panels);
  ImGui::PopID();
  if (!changed) return;
  collider = *changed;
  requests.emplace_back(Edit{SetColliders{std::move(colliders)}, panels.field.edit_in_progress});
}

}  // namespace hooke
