// Drawn over the scene: the hint for an empty scene, the selection box, short messages, and banners, such as the one
// that explains why a run stopped.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/round_number.h"
#include "draw/colors.h"
#include "scene/parameters.h"
#include "sim/methods/integrator.h"
#include "ui/panels.h"
#include "ui/strain_legend.h"
#include "ui/text.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

// Long enough to be read twice [s].
double reading_time(const std::string& text) { return std::max(3.0, 0.08 * static_cast<double>(text.size())); }

ImVec2 place(const Rect& scene, double x, double y) { return {static_cast<float>(scene.x + x), static_cast<float>(scene.y + y)}; }

// Below the scene, where the side panel does not have it.
void legend(const PanelInput& input) {
  const Rect& strip = input.layout.legend;
  if (strip.height <= 0.0) return;
  begin_panel("legend", strip, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddLine(corner(strip), {static_cast<float>(strip.x + strip.width), static_cast<float>(strip.y)}, palette::line);
  draw_strain_legend(*input.status.snapshot, strip, list);
  ImGui::End();
}

void hint_of_empty_scene(const PanelInput& input, const Panels& panels, ImDrawList& list) {
  const bool has_preview = input.marks != nullptr && !input.marks->ghost_lines.empty();
  if (input.status.snapshot->system->point_count() > 0 || panels.placement.is_on() || has_preview) return;
  const Rect& scene = input.layout.scene;
  const std::string text = wrapped("Press A and click to add points, T to attach springs, Space to run.",
                                   std::max(1.0f, static_cast<float>(scene.width) - units(32.0)));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  list.AddText(place(scene, 0.5 * (scene.width - size.x), 0.36 * scene.height), palette::dim, text.c_str());
}

// Whether any point is within the picture; of a large scene, some hundred are looked at.
bool is_in_view(const PanelInput& input) {
  const Snapshot& snapshot = *input.status.snapshot;
  const Rect& scene = input.layout.scene;
  const glm::dmat4 transform = input.camera.projection_matrix(scene.width / scene.height) * input.camera.view_matrix();
  constexpr std::size_t some = 512;
  const std::vector<Vec3>& positions = snapshot.state.position;
  for (std::size_t i = 0; i < positions.size(); i += 1 + positions.size() / some) {
    const glm::dvec4 at = transform * glm::dvec4(positions[i], 1.0);
    if (at.w > 0.0 && std::abs(at.x) <= at.w && std::abs(at.y) <= at.w) return true;
  }
  return positions.empty();
}

void hint_out_of_view(const PanelInput& input, ImDrawList& list) {
  if (is_in_view(input)) return;
  const Rect& scene = input.layout.scene;
  const std::string text = "Out of view: press " + key_text(shortcut_of(Action::FrameAll));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at = place(scene, 0.5 * (scene.width - size.x), 0.36 * scene.height);
  shaded_text(list, at, text, {14.0f, 8.0f}, 8.0);
}

// The length of the spring that is being attached, beside its middle.
void live_length(const PanelInput& input, ImDrawList& list) {
  if (input.marks == nullptr || !input.marks->ghost_spring || input.tool.action == Action::DragTool) return;
  const auto& [from, to] = *input.marks->ghost_spring;
  const Rect& scene = input.layout.scene;
  const Vec3 middle = input.camera.project(0.5 * (from + to), {scene.width, scene.height});
  const std::string text = quantity_text(glm::distance(from, to), "m");
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at = place(scene, middle.x - 0.5 * size.x, middle.y - size.y - units(10.0));
  shaded_text(list, at, text, {5.0f, 2.0f});
}

// A round length as it appears at the camera's target.
void scale_bar(const PanelInput& input, ImDrawList& list) {
  constexpr double longest = 120.0;  // [design units]
  const Rect& scene = input.layout.scene;
  if (!input.camera.orthographic || scene.width < 3.0 * units(longest) || scene.height < units(120.0)) return;
  const double meters = input.camera.meters_per_pixel(input.camera.target, {scene.width, scene.height});
  const double length = round_below(units(longest) * meters);
  const auto width = static_cast<float>(length / meters);
  const ImVec2 end = place(scene, scene.width - units(18.0), scene.height - units(16.0)), begin{end.x - width, end.y};
  const float tick = units(4.0);
  const ImVec2 line[] = {{begin.x, begin.y - tick}, begin, end, {end.x, end.y - tick}};
  list.AddPolyline(line, 4, palette::dim, 0, units(1.5));
  ImGui::PushFont(fonts().small);
  const std::string text = quantity_text(length, "m");
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  list.AddText({0.5f * (begin.x + end.x - size.x), end.y - units(3.0) - size.y}, palette::dim, text.c_str());
  ImGui::PopFont();
}

// What a length of the arrows means, at the bottom left.
void arrow_scales(const PanelInput& input, const Panels& panels, ImDrawList& list) {
  if (input.marks == nullptr) return;
  const Rect& scene = input.layout.scene;
  const double meters = input.camera.meters_per_pixel(input.camera.target, {scene.width, scene.height});
  const Palette colors = palette_for(background_of(panels.look));
  float y = static_cast<float>(scene.y + scene.height) - units(16.0);
  std::optional<Arrows::Kind> last;
  for (const Arrows& arrows : input.marks->arrows) {
    if (arrows.kind == std::exchange(last, arrows.kind)) continue;
    const bool is_force = arrows.kind != Arrows::Kind::Velocity;
    const double value = round_below(units(90.0) * meters / arrows.scale);
    const auto length = static_cast<float>(value * arrows.scale / meters);
    const float x = static_cast<float>(scene.x) + units(16.0), head = units(6.0);
    const ImU32 color = to_imgui(is_force ? colors.force : colors.velocity);
    list.AddLine({x, y}, {x + length, y}, color, units(2.0));
    list.AddTriangleFilled({x + length, y}, {x + length - head, y - 0.6f * head}, {x + length - head, y + 0.6f * head}, color);
    const std::string text = (!is_force                           ? "velocity "
                              : arrows.kind == Arrows::Kind::Load ? "load "
                                                                  : "force ") +
                             quantity_text(value, is_force ? "N" : "m/s");
    list.AddText({x + length + units(8.0), y - 0.55f * ImGui::GetFontSize()}, palette::text, text.c_str());
    y -= units(20.0);
  }
}

// Of the points, as files and plots have them; in a large scene only of the selected ones.
void point_numbers(const PanelInput& input, const Panels& panels, ImDrawList& list) {
  if (!panels.view.point_numbers) return;
  constexpr Index max_numbers = 500;
  const System& system = *input.status.snapshot->system;
  const Rect& scene = input.layout.scene;
  const glm::dvec2 size(scene.width, scene.height);
  ImGui::PushFont(fonts().small);
  for (Index i = 0; i < system.point_count(); ++i) {
    if (system.point_count() > max_numbers && !input.selection.contains(system.points()[i].id)) continue;
    const Vec3 at = input.camera.project(input.status.snapshot->state.position[i], size);
    if (!(at.z >= 0.0 && at.z <= 1.0)) continue;
    const double ball = system.points()[i].radius / input.camera.meters_per_pixel(input.status.snapshot->state.position[i], size);
    list.AddText(place(scene, at.x + 0.7 * ball + units(3.0), at.y - 0.7 * ball - units(15.0)), palette::text, std::to_string(i).c_str());
  }
  ImGui::PopFont();
}

void rubber_band(const PanelInput& input, ImDrawList& list) {
  if (!input.tool.rubber_band) return;
  const ImVec2 min = corner(*input.tool.rubber_band), size = extent(*input.tool.rubber_band);
  const ImVec2 max{min.x + size.x, min.y + size.y};
  list.AddRectFilled(min, max, (palette::accent & ~IM_COL32_A_MASK) | IM_COL32(0, 0, 0, 30));
  list.AddRect(min, max, palette::accent);
}

// The path of a cut: a light line on a dark one, visible on any cloth.
void stroke(const PanelInput& input, ImDrawList& list) {
  if (input.tool.stroke.size() < 2) return;
  std::vector<ImVec2> stroke_points;
  for (const glm::dvec2& at : input.tool.stroke) stroke_points.push_back(place(input.layout.scene, at.x, at.y));
  const auto count = static_cast<int>(stroke_points.size());
  list.AddPolyline(stroke_points.data(), count, palette::shade, 0, units(5.0));
  list.AddPolyline(stroke_points.data(), count, palette::accent, 0, units(2.0));
}

void toast(const PanelInput& input, Panels& panels, ImDrawList& list) {
  Messages& messages = panels.messages;
  if (messages.toast.empty()) return;
  const double now = ImGui::GetTime();
  if (messages.toast_until < 0.0) messages.toast_until = now + reading_time(messages.toast);
  if (now >= messages.toast_until) return messages.toast.clear();
  const Rect& scene = input.layout.scene;
  const float dx = units(14.0), dy = units(8.0), max_width = std::max(1.0f, static_cast<float>(scene.width) - 2.0f * (dx + units(8.0)));
  const std::string text = wrapped(messages.toast, max_width);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at = place(scene, 0.5 * (scene.width - size.x), scene.height - units(70.0) - size.y);
  const ImVec2 min{at.x - dx, at.y - dy}, max{at.x + size.x + dx, at.y + size.y + dy};
  shaded_text(list, at, text, {14.0f, 8.0f}, 8.0);
  // it stays while it is being read
  if (ImGui::IsMouseHoveringRect(min, max, false)) messages.toast_until = std::max(messages.toast_until, now + 1.0);
}

// "Start over with Baraff-Witkin and 4 substeps (0.59× real time)"
std::string remedy_label(const Remedy& remedy, const Settings& settings) {
  const Advice& advice = remedy.cheapest->advice;
  std::string text = remedy.from ? "Continue from t = " + quantity_text(*remedy.from, "s") + " with " : "Start over with ";
  if (advice.integrator != settings.integrator) text.append(advice.integrator->label).append(" and ");
  return text + count(advice.substeps, "substep") + speed_text(*remedy.cheapest, " (", ")");
}

// Runs from the state that the remedy was tested from.
void run_from(const Remedy& remedy, Requests& requests) {
  requests.emplace_back(remedy.from ? Control(GoToTime{*remedy.from}) : Control(GoToStart{}));
  requests.emplace_back(Control(SetRunning{true}));
}

// Sets what was tested, beyond the slider's range if needed.
void take(const Advice& advice, const Settings& settings, Requests& requests) {
  const bool changes_method = advice.integrator != settings.integrator;
  if (changes_method) requests.emplace_back(Edit{SetIntegrator{advice.integrator}});
  requests.emplace_back(Edit{RestoreParameter{&substeps_parameter, static_cast<double>(advice.substeps)}, changes_method});
}

// A button of the banner of a run that stopped, and what it requests.
struct WayOut {
  std::string label, hint;
  std::function<void(Requests&)> take;
};

std::string lines_of(const std::vector<std::string>& warnings) {
  std::string text;
  for (const std::string& warning : warnings) text += "\nWarning: " + warning;
  return text;
}

std::vector<WayOut> ways_out(const PanelInput& input) {
  const Status& status = input.status;
  const Settings& settings = status.snapshot->settings;
  std::vector<WayOut> ways;
  if (const auto& found = input.results.remedy.found) {
    const Remedy& remedy = *found;
    const auto add_setting = [&](const std::string& label, const TestedSetting& setting, const char* kind) {
      ways.push_back({label, std::string("Uses ") + kind + " and continues the run" + lines_of(setting.warnings), [&](Requests& requests) {
                        take(setting.advice, settings, requests);
                        run_from(remedy, requests);
                      }});
    };
    if (remedy.cheapest) add_setting(remedy_label(remedy, settings) + "###remedy", *remedy.cheapest, "the tested setting");
    if (const auto& same = remedy.same_method ? remedy.same_method : remedy.untested; same && remedy.cheapest)
      add_setting("Keep the method, " + count(same->advice.substeps, "substep") + speed_text(*same, " (", ")") + "###same", *same,
                  remedy.same_method ? "the tested setting" : "a setting that takes too long to be tested");
    if (remedy.change)
      ways.push_back(
          {"Restore the previous value###restore", "Undoes " + remedy.change->text + " and continues the run", [&](Requests& requests) {
             bool continues = false;
             for (const Command& command : remedy.change->restore) requests.emplace_back(Edit{command, std::exchange(continues, true)});
             run_from(remedy, requests);
           }});
  }
  if (!status.history.undo_name.empty())
    ways.push_back({"Undo###undo", status.history.undo_name, [](Requests& requests) { requests.emplace_back(Action::Undo); }});
  if (status.snapshot->divergence->point || status.snapshot->divergence->spring)
    ways.push_back({"Show where###show", "Moves the camera to where the run failed",
                    [](Requests& requests) { requests.emplace_back(ShowFailure{}); }});
  return ways;
}

// A message with buttons below it.
struct Banner {
  const char* name;
  std::vector<std::string> texts, buttons;
  ImU32 ground, edge;
};

// Computed, because ImGui fits a window to the content of the frame before, and a text that has become longer would cut the buttons.
float height_of(const Banner& banner, ImVec2 padding, float width) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float inner = width - 2.0f * padding.x;
  float height = 2.0f * padding.y + ImGui::GetFrameHeight();
  for (const std::string& text : banner.texts) height += ImGui::CalcTextSize(wrapped(text, inner).c_str()).y + 2.0f * style.ItemSpacing.y;
  float end = 0.0f;  // of the row of buttons
  for (const std::string& label : banner.buttons) {
    const float button = ImGui::CalcTextSize(label.c_str()).x + 2.0f * style.FramePadding.x;
    const bool is_new_row = end > 0.0f && end + style.ItemSpacing.x + button > inner;
    if (is_new_row) height += ImGui::GetFrameHeight() + style.ItemSpacing.y;
    end = is_new_row || end == 0.0f ? button : end + style.ItemSpacing.x + button;
  }
  return height;
}

// Begins a banner `down` below the top of the scene with its texts; the buttons are built between begin and end. end returns its height.
void begin_banner(const Banner& banner, const Rect& scene, double down, Panels& panels) {
  const float width = std::min(static_cast<float>(scene.width) - units(32.0), units(620.0));
  const ImVec2 padding(units(18.0), units(12.0));
  ImGui::SetNextWindowPos(place(scene, 0.5 * (scene.width - width), units(14.0) + down));
  ImGui::SetNextWindowSize({width, height_of(banner, padding, width)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, units(6.0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, banner.ground);
  ImGui::PushStyleColor(ImGuiCol_Button, palette::pressed);
  ImGui::Begin(banner.name, nullptr, fixed_panel);
  panels.shown.floating.push_back(current_window());

  const ImVec2 min = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  ImGui::PushClipRect(min, {min.x + size.x, min.y + size.y}, false);
  ImGui::GetWindowDrawList()->AddRectFilled(min, {min.x + units(5.0), min.y + size.y}, banner.edge, units(6.0),
                                            ImDrawFlags_RoundCornersLeft);
  ImGui::PopClipRect();
  for (const std::string& text : banner.texts) {
    paragraph(text);
    ImGui::Spacing();
  }
}

double end_banner() {
  const double height = ImGui::GetWindowSize().y;
  ImGui::End();
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar(2);
  return height;
}

void banners(const PanelInput& input, Panels& panels, Requests& requests) {
  const Status& status = input.status;
  const Rect& scene = input.layout.scene;
  double down = 0.0;
  const auto& divergence = status.snapshot->divergence;
  if (!divergence) panels.banners.dismissed.reset();

  // why the run stopped
  if (divergence && !status.diagnosis.message.empty() && panels.banners.dismissed != divergence->time) {
    const Settings& settings = status.snapshot->settings;
    const auto& [test, found] = input.results.remedy;
    const std::string outcome = found ? describe(*found, settings) : test.empty() ? "" : test + "...";
    Banner banner{"stopped", {status.diagnosis.message}, {"Dismiss"}, palette::alarm, palette::bad};
    const auto& changes = status.diagnosis.failed ? status.diagnosis.failed->changes : std::vector<RecentChange>{};
    if (!found && !changes.empty()) banner.texts.back() += " Undo the last change if it is the cause: " + changes.front().text + ".";
    if (!outcome.empty()) banner.texts.push_back(outcome);
    const std::vector<WayOut> ways = ways_out(input);
    for (const WayOut& way : ways) banner.buttons.push_back(way.label.substr(0, way.label.find("###")));
    begin_banner(banner, scene, down, panels);
    if (ImGui::Button("Dismiss")) panels.banners.dismissed = divergence->time;
    for (const WayOut& way : ways) {
      same_line_for(way.label.substr(0, way.label.find("###")).c_str());
      const bool is_pressed = ImGui::Button(way.label.c_str());
      if (!way.hint.empty()) tooltip(way.hint);
      if (!is_pressed) continue;
      way.take(requests);
      if (!way.label.ends_with("###show")) panels.banners.file_warnings.clear();
    }
    down += end_banner() + units(8.0);
  }

  // the open file changed on disk
  if (!panels.banners.file_notice.empty()) {
    const std::vector<std::string> buttons =
        panels.banners.file_is_missing ? std::vector<std::string>{"OK"} : std::vector<std::string>{"Reload", "Keep mine"};
    begin_banner({"file", {panels.banners.file_notice}, buttons, palette::notice, palette::warning}, scene, down, panels);
    std::optional<Answer> answer;
    if (!panels.banners.file_is_missing) {
      if (ImGui::Button("Reload")) answer = Answer::Reload;
      same_line_for("Keep mine");
    }
    if (ImGui::Button(buttons.back().c_str())) answer = Answer::KeepMine;
    down += end_banner() + units(8.0);
    if (answer) requests.emplace_back(*answer);
  }

  // warnings about the opened file
  if (!panels.banners.file_warnings.empty() && down == 0.0) {
    begin_banner({"remarks", {panels.banners.file_warnings}, {"Dismiss"}, palette::notice, palette::warning}, scene, down, panels);
    if (ImGui::Button("Dismiss")) panels.banners.file_warnings.clear();
    end_banner();
  }
}

}  // namespace

void build_overlays(const PanelInput& input, Panels& panels, Requests& requests) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Rect& scene = input.layout.scene;
  list.PushClipRect(corner(scene), place(scene, scene.width, scene.height));
  hint_of_empty_scene(input, panels, list);
  hint_out_of_view(input, list);
  scale_bar(input, list);
  arrow_scales(input, panels, list);
  point_numbers(input, panels, list);
  live_length(input, list);
  rubber_band(input, list);
  stroke(input, list);
  toast(input, panels, list);
  list.PopClipRect();
  legend(input);
  banners(input, panels, requests);
}

}  // namespace hooke
