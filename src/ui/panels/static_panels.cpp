#include "ui/panels/static_panels.h"

#include <imgui.h>

#include <algorithm>

#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

// ImGui windows take some frames to adapt to their content.
constexpr int frames_to_settle = 3;

// A line at the bottom left of a rectangle, legible on any ground.
void draw_stamp(const std::string& text, const Rect& place) {
  const float dx = units(8.0), dy = units(5.0), room = std::max(1.0f, static_cast<float>(place.width) - 4.0f * dx);
  const std::string lines = wrapped(text, room);
  const ImVec2 size = ImGui::CalcTextSize(lines.c_str());
  const ImVec2 at{static_cast<float>(place.x) + 2.0f * dx, static_cast<float>(place.y + place.height) - size.y - 3.0f * dy};
  shaded_text(*ImGui::GetForegroundDrawList(), at, lines, {8.0f, 5.0f});
}

}  // namespace

StaticPanels::StaticPanels(int width, int height, const ViewOptions& view, Shown shown)
    : layout_(lay_out(width, height, view.scale)), has_panels_(shown.panels) {
  panels_.view = view;
  panels_.shown.accuracy = shown.accuracy;
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = io.LogFilename = nullptr;
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.MousePos = {-1.0f, -1.0f};
  load_theme(view.scale, 1.0);
}

StaticPanels::~StaticPanels() { ImGui::DestroyContext(); }

const ImDrawData* StaticPanels::build(const Status& status, const Camera& camera, const std::filesystem::path& file,
                                      const std::string& stamp, const Marks* marks) {
  if (status.snapshot->system != forecast_.system)
    forecast_ = make_forecast(status.snapshot->system, status.snapshot->state, forecast_, std::atomic<bool>(false));
  const PanelInput input{.status = status,
                         .selection = selection_,
                         .layout = layout_,
                         .tool = {tool_buttons(), tool_buttons().front().action},
                         .file = file,
                         .camera = camera,
                         .results = {.forecast = &forecast_},
                         .marks = marks};
  for (int frame = 0; frame < frames_to_settle; ++frame) {
    ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
    ImGui::NewFrame();
    Requests ignored_requests;
    use_look(panels_.look);
    if (has_panels_) build_panels(input, panels_, ignored_requests);
    if (!stamp.empty())
      draw_stamp(stamp, has_panels_ ? layout_.scene : Rect{0.0, 0.0, ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y});
    ImGui::Render();
  }
  return ImGui::GetDrawData();
}

}  // namespace hooke
