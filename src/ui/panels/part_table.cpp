// The table of points or springs below the scene: sorted by any column, with fields for what can be edited.
#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "ui/panels.h"
#include "ui/text.h"
#include "ui/typed_field.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

struct Column {
  const char* label;
  double (*value)(const Snapshot& now, Index i);
  Command (*edit)(const Snapshot& now, Index i, double value) = nullptr;  // null: cannot be edited
  double min = -typed::max_length, max = typed::max_length;
};

Point point_at(const Snapshot& now, Index i) { return now.system->points()[i]; }
Spring spring_at(const Snapshot& now, Index s) { return now.system->springs()[s]; }

double number_of(const Snapshot&, Index i) { return static_cast<double>(i); }

template <int Axis>
constexpr Column place(const char* label) {
  return {label, [](const Snapshot& now, Index i) { return now.state.position[i][Axis]; },
          [](const Snapshot& now, Index i, double value) -> Command {
            Vec3 position = now.state.position[i];
            position[Axis] = value;
            return Move{{{point_at(now, i).id, position, now.state.velocity[i]}}};
          }};
}

template <int Axis>
constexpr Column velocity(const char* label) {
  return {label, [](const Snapshot& now, Index i) { return now.state.velocity[i][Axis]; },
          [](const Snapshot& now, Index i, double value) -> Command {
            Vec3 set = now.state.velocity[i];
            set[Axis] = value;
            return SetVelocity{{{point_at(now, i).id, set}}};
          }};
}

template <SpringProperty Property, double Spring::*Member>
constexpr Column property(const char* label, double max) {
  return {label, [](const Snapshot& now, Index s) { return spring_at(now, s).*Member; },
          [](const Snapshot& now, Index s, double value) -> Command {
            return SetSpringProperty{Property, {{spring_at(now, s).id, value}}};
          },
          0.0, max};
}

constexpr Column mass = {"mass [kg]", [](const Snapshot& now, Index i) { return point_at(now, i).mass; },
                         [](const Snapshot& now, Index i, double value) -> Command {
                           return SetPointProperty{PointProperty::Mass, {{point_at(now, i).id, value}}};
                         },
                         typed::min_mass, typed::max_mass};

constexpr Column flat_columns[] = {{"#", number_of},        place<0>("x [m]"),       place<1>("y [m]"),
                                   velocity<0>("vx [m/s]"), velocity<1>("vy [m/s]"), mass};
constexpr Column point_columns[] = {{"#", number_of},        place<0>("x [m]"),       place<1>("y [m]"),       place<2>("z [m]"),
                                    velocity<0>("vx [m/s]"), velocity<1>("vy [m/s]"), velocity<2>("vz [m/s]"), mass};
constexpr Column spring_columns[] = {
    {"#", number_of},
    {"from", [](const Snapshot& now, Index s) { return static_cast<double>(now.system->index_of(spring_at(now, s).first)); }},
    {"to", [](const Snapshot& now, Index s) { return static_cast<double>(now.system->index_of(spring_at(now, s).second)); }},
    {"length [m]", [](const Snapshot& now,
                      Index s) { return glm::distance(now.position(spring_at(now, s).first), now.position(spring_at(now, s).second)); }},
    {"strain", [](const Snapshot& now, Index s) { return strain(*now.system, now.state, spring_at(now, s)); }},
    {"force [N]", [](const Snapshot& now, Index s) { return tension(*now.system, now.state, spring_at(now, s)); }},
    property<SpringProperty::Stiffness, &Spring::stiffness>("k [N/m]", typed::max_stiffness),
    property<SpringProperty::Damping, &Spring::damping>("d [N s/m]", typed::max_damping),
    property<SpringProperty::RestLength, &Spring::rest_length>("rest length [m]", typed::max_length),
};

// Not while a field is being edited: its row would move away.
void sort(PartTable& table, std::span<const Column> columns, std::size_t count, const Snapshot& now) {
  constexpr std::size_t max_followed = 2000;  // rows that are sorted in each frame
  const bool is_other = table.order.size() != count;
  if (is_other) {
    table.order.resize(count);
    std::iota(table.order.begin(), table.order.end(), Index{0});
  }
  ImGuiTableSortSpecs* wanted = ImGui::TableGetSortSpecs();
  if (wanted == nullptr || wanted->SpecsCount == 0 || ImGui::IsAnyItemActive()) return;
  if (!is_other && !std::exchange(wanted->SpecsDirty, false) && count > max_followed) return;
  const Column& column = columns[static_cast<std::size_t>(wanted->Specs[0].ColumnIndex)];
  const double sign = wanted->Specs[0].SortDirection == ImGuiSortDirection_Descending ? -1.0 : 1.0;
  std::vector<double> keys(count);
  for (std::size_t i = 0; i < count; ++i) keys[i] = sign * column.value(now, static_cast<Index>(i));
  std::ranges::stable_sort(table.order, {}, [&](Index i) { return keys[static_cast<std::size_t>(i)]; });
}

// The first column selects the part; with Ctrl, one more.
void build_row(Index i, std::span<const Column> columns, bool springs, const PanelInput& input, Panels& panels, Requests& requests) {
  const Snapshot& now = *input.status.snapshot;
  ImGui::TableNextRow();
  ImGui::PushID(i);
  ImGui::TableNextColumn();
  Selection selection = springs ? Selection{{}, {spring_at(now, i).id}} : Selection{{point_at(now, i).id}, {}};
  const bool is_selected = springs ? input.selection.contains(selection.springs[0]) : input.selection.contains(selection.points[0]);
  if (is_selected) ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg0, palette::tinted);
  if (ImGui::Selectable(std::to_string(i).c_str())) {
    if (ImGui::GetIO().KeyCtrl) selection.add(input.selection);
    requests.emplace_back(Select{std::move(selection)});
  }
  for (const Column& column : columns.subspan(1)) {
    ImGui::TableNextColumn();
    const double value = column.value(now, i);
    if (column.edit == nullptr) {
      ImGui::TextUnformatted(number_text(value).c_str());
      continue;
    }
    ImGui::PushID(column.label);
    if (const auto typed = typed_cell({.label = column.label, .min = column.min, .max = column.max, .value = value}, -1.0f, panels))
      requests.emplace_back(Edit{column.edit(now, i, *typed)});
    ImGui::PopID();
  }
  ImGui::PopID();
}

void build_table(std::span<const Column> columns, bool springs, const PanelInput& input, Panels& panels, Requests& requests) {
  const Snapshot& now = *input.status.snapshot;
  const ImGuiTableFlags flags = ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_Resizable |
                                ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable(springs ? "springs" : "points", static_cast<int>(columns.size()), flags)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  for (const Column& column : columns) ImGui::TableSetupColumn(column.label);
  ImGui::TableHeadersRow();
  PartTable& table = panels.plots.table;
  if (std::exchange(table.of_springs, springs) != springs) table.order.clear();
  sort(table, columns, static_cast<std::size_t>(springs ? now.system->spring_count() : now.system->point_count()), now);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(table.order.size()));
  while (clipper.Step())
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row)
      build_row(table.order[static_cast<std::size_t>(row)], columns, springs, input, panels, requests);
  ImGui::EndTable();
}

}  // namespace

void build_part_table(const PanelInput& input, Panels& panels, Requests& requests) {
  const Rect& dock = input.layout.plots;
  if (dock.height <= 0.0) return;
  begin_panel("table", dock);
  ImGui::PushFont(fonts().small);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {units(4.0), units(1.0)});
  const bool is_flat = input.status.snapshot->system->dimensions == 2;
  if (ImGui::BeginTabBar("parts")) {
    if (ImGui::BeginTabItem("Points")) {
      build_table(is_flat ? std::span<const Column>(flat_columns) : point_columns, false, input, panels, requests);
      ImGui::EndTabItem();
    }
    if (ImGui::BeginTabItem("Springs")) {
      build_table(spring_columns, true, input, panels, requests);
      ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
  }
  ImGui::PopStyleVar();
  ImGui::PopFont();
  ImGui::End();
}

}  // namespace hooke
