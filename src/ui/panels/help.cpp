// The F1 overlay: all shortcuts by group, and the mouse gestures, in as many columns as fit.
#include <algorithm>
#include <utility>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

constexpr double column_width = 330.0;  // [design units]
constexpr int max_columns = 3;
constexpr double heading_lines = 1.6;  // a heading and the gap above it, in lines

struct Line {
  std::string left;
  std::string_view right;
};
struct Group {
  std::string_view title;
  std::vector<Line> lines;
  double indent;  // of the right column [design units]
  double height() const { return heading_lines + static_cast<double>(lines.size()); }
};

// The quantities of the panel of the accuracy.
constexpr std::pair<std::string_view, std::string_view> accuracy_hints[] = {
    {"Error of a frame", "made within one frame"},
    {"Accumulated error", "made since the start"},
    {"Predictability", "until errors are large"},
    {"Energy balance", "gains and losses"},
};

std::vector<Group> all_groups() {
  std::vector<Group> groups;
  for (const Shortcut& row : shortcuts()) {
    if (groups.empty() || groups.back().title != row.group) groups.push_back({row.group, {}, 112.0});
    groups.back().lines.push_back({key_text(row), row.text});
  }
  groups.push_back({"Mouse", {}, 170.0});
  for (const MouseHint& hint : mouse_hints()) groups.back().lines.push_back({std::string(hint.gesture), hint.text});
  groups.push_back({"Accuracy", {}, 170.0});
  for (const auto& [quantity, meaning] : accuracy_hints) groups.back().lines.push_back({std::string(quantity), meaning});
  return groups;
}

void build_group(const Group& group) {
  ImGui::Dummy({0.0f, units(3.0)});
  strong_text(std::string(group.title), palette::accent);
  for (const Line& line : group.lines) {
    ImGui::TextUnformatted(line.left.c_str());
    ImGui::SameLine(units(group.indent));
    dim_text(std::string(line.right));
  }
}

// Groups are not split and keep their order; columns are balanced.
void build_columns(int columns) {
  const std::vector<Group> groups = all_groups();
  double rest = 0.0;
  for (const Group& group : groups) rest += group.height();
  double filled = 0.0;
  for (const Group& group : groups) {
    const double fraction = (rest + filled) / columns;
    if (filled > 0.0 && columns > 1 && filled + 0.5 * group.height() > fraction) {
      ImGui::NextColumn();
      --columns;
      filled = 0.0;
    }
    build_group(group);
    filled += group.height();
    rest -= group.height();
  }
}

}  // namespace

void build_keys(const PanelInput& input, Panels& panels) {
  if (!panels.shown.keys) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const int columns = std::clamp(static_cast<int>(display.x / units(column_width + 24.0)), 1, max_columns);
  const float width = std::min(display.x, static_cast<float>(columns) * units(column_width) + units(48.0));
  const Rect& page = input.layout.page;
  const float middle = static_cast<float>(page.y + 0.5 * page.height);
  ImGui::SetNextWindowPos({0.5f * display.x, middle}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, static_cast<float>(page.height)});
  begin_front_box("keys", {units(24.0), units(14.0)});
  panels.shown.floating.push_back(current_window());
  ImGui::Columns(columns, "columns", false);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, units(2.5)});
  build_columns(columns);
  ImGui::PopStyleVar();
  ImGui::Columns(1);
  end_front_box();
}

}  // namespace hooke
