#include "ui/panels/static_panels.h"

#include <imgui.h>

#include "ui/theme.h"
#include "ui/tool_buttons.h"

namespace hooke {
namespace {

// ImGui windows take some frames to adapt to their content.
constexpr int frames_to_settle = 3;

}  // namespace

StaticPanels::StaticPanels(int width, int height, const ViewOptions& view) : layout_(lay_out(width, height, view.scale)) {
  panels_.view = view;
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = io.LogFilename = nullptr;
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.MousePos = {-1.0f, -1.0f};
  load_theme(view.scale, 1.0);
}

StaticPanels::~StaticPanels() { ImGui::DestroyContext(); }

const ImDrawData* StaticPanels::build(const Status& status, const Camera& camera, const std::filesystem::path& file) {
  if (status.snapshot->system != forecast_.system)
    forecast_ = make_forecast(status.snapshot->system, status.snapshot->state, forecast_, std::atomic<bool>(false));
  const PanelInput input{.status = status,
                         .selection = selection_,
                         .layout = layout_,
                         .tools = tool_buttons(),
                         .tool = tool_buttons().front().action,
                         .next_step = {},
                         .file = file,
                         .camera = camera,
                         .forecast = &forecast_};
  for (int frame = 0; frame < frames_to_settle; ++frame) {
    ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
    ImGui::NewFrame();
    Requests ignored_requests;
    build_panels(input, panels_, ignored_requests);
    ImGui::Render();
  }
  return ImGui::GetDrawData();
}

}  // namespace hooke
