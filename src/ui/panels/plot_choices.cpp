// The list of quantities that can be plotted.
#include <algorithm>
#include <utility>

#include "base/number_text.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

// The quantities of the whole scene, in the order of the list.
constexpr std::string_view of_the_scene[] = {"kinetic",    "elastic",    "gravitational", "total",          "dissipated", "momentum_x",
                                             "momentum_y", "momentum_z", "angular_x",     "angular_y",      "angular_z",  "center_x",
                                             "center_y",   "center_z",   "least_strain",  "largest_strain", "fastest"};

// An entry of the list of quantities.
void choice(const std::string& name, const PanelInput& input, Requests& requests) {
  const System& system = *input.status.snapshot->system;
  const auto quantity = find_quantity(name, system.point_count(), system.spring_count());
  if (!quantity || (system.dimensions == 2 && quantity->row->is_spatial())) return;
  SetPlots set;
  bool is_watched = false;
  for (const Trace& trace : input.status.timeline.traces->traces) {
    const bool is_same = trace.quantity.name() == name;
    is_watched = is_watched || is_same;
    if (!is_same) set.plots.push_back(trace.quantity.name());
  }
  if (!is_watched) set.plots.push_back(name);
  const bool is_flat_turn = system.dimensions == 2 && name == "angular_z";
  const std::string text = (is_flat_turn ? "Angular momentum" : std::string(quantity->row->description)) +
                           (quantity->row->of == QuantityRow::Of::Scene ? "" : ": " + name);
  if (ImGui::MenuItem(text.c_str(), unit_text(quantity->row->unit).c_str(), is_watched)) requests.emplace_back(Edit{std::move(set)});
}

// A menu for each selected point or spring.
template <class Id>
void choices_of(const std::vector<Id>& ids, QuantityRow::Of of, const char* what, const PanelInput& input, Requests& requests) {
  constexpr std::size_t max_menus = 12;
  const System& system = *input.status.snapshot->system;
  if (!ids.empty()) ImGui::Separator();
  for (std::size_t i = 0; i < std::min(ids.size(), max_menus); ++i) {
    const Index at = system.index_of(ids[i]);
    if (at == no_index || !ImGui::BeginMenu((what + std::to_string(at)).c_str())) continue;
    for (const QuantityRow& row : quantity_rows())
      if (row.of == of) choice(std::string(row.name) + std::to_string(at), input, requests);
    ImGui::EndMenu();
  }
  if (ids.size() > max_menus) dim_text("and " + std::to_string(ids.size() - max_menus) + " more: select fewer");
}

}  // namespace

// Quantities of the scene, what is plotted of points and springs, and the selected ones.
void build_plot_choices(const PanelInput& input, Requests& requests) {
  for (const std::string_view name : of_the_scene) choice(std::string(name), input, requests);
  ImGui::Separator();
  for (const QuantityRow& row : quantity_rows())
    if (row.needs_accuracy) choice(std::string(row.name), input, requests);
  bool is_first = true;
  for (const Trace& trace : input.status.timeline.traces->traces) {
    if (trace.quantity.row->of == QuantityRow::Of::Scene) continue;
    if (std::exchange(is_first, false)) ImGui::Separator();
    choice(trace.quantity.name(), input, requests);
  }
  choices_of(input.selection.points, QuantityRow::Of::Point, "Point ", input, requests);
  choices_of(input.selection.springs, QuantityRow::Of::Spring, "Spring ", input, requests);
  if (!input.selection.has_parts()) dim_text("Select points or springs for more quantities");
}

}  // namespace hooke
