// The gallery: a page over the scene with a card for each shipped scene, by group. A click or Enter opens it.
#include "formats/gallery.h"

#include <algorithm>
#include <cmath>

#include "base/printable.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

constexpr double margin = 28.0, gap = 16.0, min_card = 250.0, inner = 12.0;  // [design units]
constexpr int description_lines = 6;

struct CardGrid {
  int columns;
  float card, picture;  // width of a card, height of its picture
};

CardGrid grid_for(float width) {
  const int columns = std::max(1, static_cast<int>((width + units(gap)) / units(min_card + gap)));
  const float card = std::floor((width - static_cast<float>(columns - 1) * units(gap)) / static_cast<float>(columns));
  return {columns, card, card * thumbnail_height / thumbnail_width};
}

std::string some_lines(const std::string& description, const CardGrid& grid) {
  return wrapped(description, grid.card - 2.0f * units(inner), description_lines);
}

void picture(const Panels& panels, std::size_t number, const ImVec2& min, const CardGrid& grid) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 max{min.x + grid.card, min.y + grid.picture};
  const float round = units(7.0);
  if (panels.gallery.thumbnails == nullptr) return list.AddRectFilled(min, max, palette::raised, round, ImDrawFlags_RoundCornersTop);
  const auto count = static_cast<int>(gallery_cards().size()), rows = 2 * ((count + thumbnail_columns - 1) / thumbnail_columns);
  const int column_index = static_cast<int>(number) % thumbnail_columns,
            row_index = 2 * (static_cast<int>(number) / thumbnail_columns) + (panels.look == Look::Light ? 1 : 0);
  const auto column = static_cast<float>(column_index), row = static_cast<float>(row_index);
  // inset by half a pixel, to prevent bleeding from neighboring pictures
  const ImVec2 half{0.5f / (thumbnail_columns * thumbnail_width), 0.5f / static_cast<float>(rows * thumbnail_height)};
  const ImVec2 uv_min{column / thumbnail_columns + half.x, row / static_cast<float>(rows) + half.y};
  const ImVec2 uv_max{(column + 1.0f) / thumbnail_columns - half.x, (row + 1.0f) / static_cast<float>(rows) - half.y};
  list.AddImageRounded(panels.gallery.thumbnails, min, max, uv_min, uv_max, IM_COL32_WHITE, round, ImDrawFlags_RoundCornersTop);
}

// Returns whether it was clicked.
bool card(const PanelInput& input, Panels& panels, std::size_t number, const CardGrid& grid, float height) {
  const GalleryCard& shown = gallery_cards()[number];
  const ImVec2 min = ImGui::GetCursorScreenPos(), max{min.x + grid.card, min.y + height};
  const bool clicked = ImGui::InvisibleButton(shown.scene->id.c_str(), {grid.card, height});
  if (ImGui::IsItemHovered() && (ImGui::GetIO().MouseDelta.x != 0.0f || ImGui::GetIO().MouseDelta.y != 0.0f))
    panels.gallery.chosen = number;
  const bool is_chosen = panels.gallery.chosen == number, is_open = input.file == shown.scene->file;
  if (is_chosen && panels.gallery.follows) ImGui::SetScrollHereY(0.5f);

  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float round = units(7.0), left = min.x + units(inner);
  list.AddRectFilled(min, max, is_chosen ? palette::hovered : palette::box, round);
  picture(panels, number, min, grid);
  list.AddRect(min, max, is_chosen ? palette::accent : palette::line, round, 0, is_chosen ? units(2.0) : 1.0f);

  ImGui::PushFont(fonts().strong);
  list.AddText({left, min.y + grid.picture + units(9.0)}, is_open ? palette::accent : palette::text, printable(shown.scene->title).c_str());
  ImGui::PopFont();
  ImGui::PushFont(fonts().small);
  const std::string text = printable(shown.description, 2000), lines = some_lines(text, grid);
  list.AddText({left, min.y + grid.picture + units(31.0)}, palette::dim, lines.c_str());
  ImGui::PopFont();
  if (lines.ends_with("...")) tooltip(text);
  return clicked;
}

float card_height(std::size_t number, const CardGrid& grid) {
  ImGui::PushFont(fonts().small);
  const float text = ImGui::CalcTextSize(some_lines(printable(gallery_cards()[number].description, 2000), grid).c_str()).y;
  ImGui::PopFont();
  return grid.picture + units(31.0) + text + units(13.0);
}

void heading(const std::string& title) {
  ImGui::Dummy({0.0f, units(10.0)});
  strong_text(title, palette::accent);
  ImGui::Dummy({0.0f, units(2.0)});
}

// The cards of a group; the highest card determines the height of its row. Returns the end of the group.
std::size_t group(const PanelInput& input, Panels& panels, std::size_t first, const CardGrid& grid, Requests& requests) {
  const std::vector<GalleryCard>& cards = gallery_cards();
  std::size_t end = first;
  while (end < cards.size() && cards[end].scene->group == cards[first].scene->group) ++end;
  heading(std::string(cards[first].scene->group));
  for (std::size_t row = first; row < end; row += static_cast<std::size_t>(grid.columns)) {
    const std::size_t row_end = std::min(end, row + static_cast<std::size_t>(grid.columns));
    float height = 0.0f;
    for (std::size_t i = row; i < row_end; ++i) height = std::max(height, card_height(i, grid));
    for (std::size_t i = row; i < row_end; ++i) {
      if (i > row) ImGui::SameLine(0.0f, units(gap));
      if (card(input, panels, i, grid, height)) requests.emplace_back(OpenFile{cards[i].scene->file});
    }
    ImGui::Dummy({0.0f, units(gap) - ImGui::GetStyle().ItemSpacing.y});
  }
  return end;
}

}  // namespace

bool move_in_gallery(Panels& panels, const Layout& layout, Key key) {
  const auto count = static_cast<long>(gallery_cards().size());
  const long columns = grid_for(static_cast<float>(layout.status.width) - 2.0f * units(margin)).columns;
  const long step = key == Key::Right ? 1 : key == Key::Left ? -1 : key == Key::Down ? columns : key == Key::Up ? -columns : 0;
  if (step == 0) return false;
  panels.gallery.chosen = static_cast<std::size_t>(std::clamp(static_cast<long>(panels.gallery.chosen) + step, 0l, count - 1));
  panels.gallery.follows = true;
  return true;
}

void build_gallery(const PanelInput& input, Panels& panels, Requests& requests) {
  const Rect& page = input.layout.page;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(margin), units(10.0)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::panel);
  begin_panel("gallery", page);
  ImGui::PopStyleColor();
  panels.shown.floating.push_back(page);

  ImGui::Dummy({0.0f, units(6.0)});
  strong_text("Gallery");
  paragraph("Open a scene to run, change and save it under another name. Arrow keys and Enter select one, Esc returns.", palette::dim);
  const CardGrid grid = grid_for(static_cast<float>(page.width) - 2.0f * units(margin));
  for (std::size_t first = 0; first < gallery_cards().size();) first = group(input, panels, first, grid, requests);
  panels.gallery.follows = false;
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace hooke
