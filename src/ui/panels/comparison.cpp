// Cost against error of the methods on this scene: a chart whose points are settings to choose.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "lab/accuracy/accuracy_text.h"
#include "scene/parameters.h"
#include "sim/methods/integrator.h"
#include "study/work_precision_file.h"
#include "ui/docked_panel.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

// The lines have the colors of plots; the methods after the first six repeat them dashed, those after twelve with short dashes. The markers
// have as many corners as the style says: 0 is a circle.
constexpr std::size_t color_count = std::size(palette::inks);
ImU32 color_of(std::size_t method) { return palette::inks[method % color_count]; }

void draw_marker(ImDrawList& list, ImVec2 at, std::size_t method) {
  constexpr std::array corners{0, 4, 3, 5};
  list.AddNgonFilled(at, units(4.0), color_of(method), corners[method % corners.size()] == 0 ? 16 : corners[method % corners.size()]);
}

void draw_segment(ImDrawList& list, ImVec2 from, ImVec2 to, std::size_t method) {
  const std::size_t repetition = method / color_count;
  if (repetition == 0) return list.AddLine(from, to, color_of(method), units(1.5));
  const float dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy), dash = units(5.0f / static_cast<float>(repetition));
  for (float at = 0.0f; at < length; at += 2.0f * dash) {
    const float s = at / length, t = std::min(at + dash, length) / length;
    list.AddLine({from.x + s * dx, from.y + s * dy}, {from.x + t * dx, from.y + t * dy}, color_of(method), units(1.5));
  }
}

bool is_drawn(const Row& row) {
  return row.error && row.cpu_ms_per_s && *row.error > 0.0 && *row.cpu_ms_per_s > 0.0 && row.relative_error < 1.0;
}

// Of a power of ten [ms]: "10 ms", "100 \u03bcs".
std::string cost_label(int decade) {
  constexpr std::array units_of_time{"ns", "\u03bcs", "ms", "s"};
  const int unit = std::clamp(2 + static_cast<int>(std::floor(decade / 3.0)), 0, 3);
  return number_text(std::pow(10.0, decade - 3 * (unit - 2))) + " " + units_of_time[static_cast<std::size_t>(unit)];
}

struct Chart {
  Chart(const PanelInput& panel_input, const MethodComparison& compared, ImVec2 corner, ImVec2 size)
      : input(panel_input), record(compared.record), list(*ImGui::GetWindowDrawList()) {
    for (const Row& row : record.rows)
      if (is_drawn(row)) error.include(*row.error), cost.include(*row.cpu_ms_per_s);
    at = {corner.x + units(58.0), corner.y + units(24.0)};
    end = {corner.x + size.x - units(12.0), corner.y + size.y - units(42.0)};
  }

  ImVec2 place(double ms_per_s, double meters) const {
    return {at.x + (end.x - at.x) * cost.fraction(ms_per_s), end.y - (end.y - at.y) * error.fraction(meters)};
  }

  void draw_grid() const {
    ImGui::PushFont(fonts().small);
    draw_decades(list, error, at, end, 6);
    // as many labels as have room
    const float label_width = ImGui::CalcTextSize("100 ms").x + units(8.0);
    const int every =
        std::max(1, static_cast<int>(std::ceil(label_width * static_cast<float>(cost.max - cost.min) / std::max(1.0f, end.x - at.x))));
    for (int decade = cost.min; decade <= cost.max; ++decade) {
      const float x = place(std::pow(10.0, decade), std::pow(10.0, error.min)).x;
      list.AddLine({x, at.y}, {x, end.y}, palette::line);
      if ((decade - cost.min) % every != 0) continue;
      const std::string label = cost_label(decade);
      const float wide = ImGui::CalcTextSize(label.c_str()).x;
      list.AddText({std::min(x - 0.5f * wide, end.x - wide), end.y + units(4.0)}, palette::dim, label.c_str());
    }
    const std::string short_text = "Error after " + quantity_text(record.seconds, "s");
    std::string above = short_text + " (RMS over the points)";
    const float left = at.x - units(52.0);
    if (left + ImGui::CalcTextSize(above.c_str()).x > end.x) above = short_text;
    list.AddText({left, at.y - units(21.0)}, palette::dim, above.c_str());
    const char* below = "CPU time per simulated second";
    list.AddText({end.x - ImGui::CalcTextSize(below).x, end.y + units(20.0)}, palette::dim, below);
    ImGui::PopFont();
  }

  // To the right of it, the scene runs slower than its speed setting requires.
  void draw_budget() const {
    const double budget = 1000.0 / input.status.snapshot->settings.speed;
    if (budget < std::pow(10.0, cost.min) || budget > std::pow(10.0, cost.max)) return;
    const float x = place(budget, std::pow(10.0, error.min)).x;
    list.AddLine({x, at.y}, {x, end.y}, palette::warning, units(1.5));
    ImGui::PushFont(fonts().small);
    const char* text = "real time";
    const float wide = ImGui::CalcTextSize(text).x;
    list.AddText({x + wide + units(8.0) > end.x ? x - wide - units(4.0) : x + units(4.0), at.y + units(2.0)}, palette::warning, text);
    ImGui::PopFont();
  }

  // Returns the row under the mouse, or null.
  const Row* draw_curves() const {
    const Row* under_mouse = nullptr;
    float nearest = units(9.0);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    std::size_t number_of_method = 0;
    for (const Integrator& method : integrators()) {
      const std::size_t style = number_of_method++;
      const ImVec2* last = nullptr;
      ImVec2 previous{};
      for (const Row& row : record.rows) {
        if (row.method != method.id || !is_drawn(row)) continue;
        const ImVec2 here = place(*row.cpu_ms_per_s, *row.error);
        if (last != nullptr) draw_segment(list, previous, here, style);
        draw_marker(list, here, style);
        previous = here;
        last = &previous;
        const float distance = std::hypot(here.x - mouse.x, here.y - mouse.y);
        if (distance < nearest) nearest = distance, under_mouse = &row;
      }
    }
    return under_mouse;
  }

  // A ring around the setting of the method in use that is closest to the present one.
  void draw_present() const {
    const Settings& settings = input.status.snapshot->settings;
    const Row* nearest = nullptr;
    double apart = std::numeric_limits<double>::infinity();
    for (const Row& row : record.rows) {
      if (row.method != settings.integrator->id || !is_drawn(row)) continue;
      const double distance = row.step ? std::abs(std::log(*row.step / settings.substep()))
                                       : std::abs(std::log(row.tolerance.value_or(1.0) / settings.tolerance.value_or(1e-8)));
      if (distance < apart) apart = distance, nearest = &row;
    }
    if (nearest == nullptr) return;
    const ImVec2 here = place(*nearest->cpu_ms_per_s, *nearest->error);
    list.AddCircle(here, units(8.0), palette::text, 0, units(2.0));
    ImGui::PushFont(fonts().small);
    const char* text = "now";
    // legible on the curves
    const ImVec2 size = ImGui::CalcTextSize(text);
    const ImVec2 corner{here.x + units(11.0) + size.x > end.x ? here.x - size.x - units(11.0) : here.x + units(11.0), here.y - units(7.0)};
    list.AddRectFilled({corner.x - units(2.0), corner.y}, {corner.x + size.x + units(2.0), corner.y + size.y}, palette::box, units(2.0));
    list.AddText(corner, palette::text, text);
    ImGui::PopFont();
  }

  const PanelInput& input;
  const ProblemRecord& record;
  ImDrawList& list;
  LogAxis error, cost;
  ImVec2 at{}, end{};
};

std::string setting_text(const Row& row, double frame_rate) {
  const Integrator* method = find_integrator(row.method);
  const std::string name = method != nullptr ? method->short_name() : row.method;
  const auto substeps = substeps_of(row, frame_rate);
  if (substeps) return name + ", " + count(*substeps, "substep");
  return name + ", " + (row.tolerance ? "tolerance " + quantity_text(*row.tolerance, "m", 1) : row.setting);
}

// The tolerance of an adaptive method is not a parameter of the window.
bool can_be_used(const Row& row, const Settings& settings) { return substeps_of(row, settings.frame_rate).has_value(); }

void use(const Row& row, const Settings& settings, Requests& requests) {
  requests.emplace_back(Edit{SetIntegrator{find_integrator(row.method)}});
  const int substeps = substeps_of(row, settings.frame_rate).value();
  requests.emplace_back(Edit{RestoreParameter{&substeps_parameter, static_cast<double>(substeps)}, true});
}

// Of the settings that keep most of the motion; null: none.
const Row* fastest(const ProblemRecord& record, const Settings& settings) {
  constexpr double max_relative_error = 0.1;
  const Row* least = nullptr;
  for (const Row& row : record.rows)
    if (is_drawn(row) && row.relative_error.value_or(1.0) < max_relative_error && can_be_used(row, settings) &&
        (least == nullptr || *row.cpu_ms_per_s < *least->cpu_ms_per_s))
      least = &row;
  return least;
}

// A piece of each line, since markers and colors alone repeat.
void legend(const ProblemRecord& record) {
  const float line = units(22.0), space = units(27.0);
  ImGui::PushFont(fonts().small);
  std::size_t number_of_method = 0;
  bool is_first = true;
  for (const Integrator& method : integrators()) {
    const std::size_t style = number_of_method++;
    if (std::ranges::none_of(record.rows, [&](const Row& row) { return row.method == method.id && is_drawn(row); })) continue;
    const std::string name = method.short_name();
    if (!is_first) {
      ImGui::SameLine(0.0f, units(14.0));
      if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize(name.c_str()).x + space) ImGui::NewLine();
    }
    is_first = false;
    const ImVec2 here = ImGui::GetCursorScreenPos();
    const float middle = here.y + 0.5f * ImGui::GetTextLineHeight();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_segment(list, {here.x, middle}, {here.x + line, middle}, style);
    draw_marker(list, {here.x + 0.5f * line, middle}, style);
    ImGui::SetCursorScreenPos({here.x + space, here.y});
    text_in(palette::dim, name);
  }
  ImGui::PopFont();
}

// Methods of which nothing is in the chart.
void missing_methods(const ProblemRecord& record) {
  std::string exact, failed;
  for (const Integrator& method : integrators()) {
    bool is_exact = false, is_in_chart = false;
    for (const Row& row : record.rows)
      if (row.method == method.id) is_in_chart |= is_drawn(row), is_exact |= row.error == 0.0;
    std::string& names = is_exact ? exact : failed;
    if (!is_in_chart) names += (names.empty() ? "" : ", ") + method.short_name();
  }
  ImGui::PushFont(fonts().small);
  if (!exact.empty()) paragraph("The same as the reference: " + exact, palette::dim);
  if (!failed.empty()) paragraph("Too slow or unstable here: " + failed, palette::dim);
  ImGui::PopFont();
}

void chart(const PanelInput& input, const MethodComparison& comparison, float width, float height, Requests& requests) {
  const ImVec2 corner = ImGui::GetCursorScreenPos(), size{width, height};
  ImGui::InvisibleButton("chart", size);
  const bool is_over = ImGui::IsItemHovered(), is_clicked = ImGui::IsItemClicked();
  const Chart chart(input, comparison, corner, size);
  chart.draw_grid();
  chart.draw_budget();
  const Row* row = chart.draw_curves();
  chart.draw_present();
  if (row == nullptr || !is_over) return;
  const Settings& settings = input.status.snapshot->settings;
  chart.list.AddCircle(chart.place(*row->cpu_ms_per_s, *row->error), units(6.0), palette::accent, 0, units(2.0));
  ImGui::SetTooltip("%s\nerror %s\n%s of CPU time per simulated second%s", setting_text(*row, settings.frame_rate).c_str(),
                    length_text(*row->error).c_str(), quantity_text(1e-3 * *row->cpu_ms_per_s, "s").c_str(),
                    can_be_used(*row, settings) ? "\nClick to use it" : "");
  if (is_clicked && can_be_used(*row, settings)) use(*row, settings, requests);
}

void buttons(const PanelInput& input, Panels& panels, Requests& requests) {
  const ResultStatus<MethodComparison>& status = input.results.comparison;
  const Settings& settings = input.status.snapshot->settings;
  if (status.is_running) {
    if (ImGui::Button("Cancel", {units(84.0), units(30.0)})) requests.emplace_back(StopComparison{});
  } else if (ImGui::Button("Again", {units(50.0), units(30.0)})) {
    requests.emplace_back(Action::CompareMethods);
  }
  if (status.result && !status.result->record.rows.empty()) {
    ImGui::SameLine();
    if (ImGui::Button("Save...", {units(66.0), units(30.0)})) ImGui::OpenPopup("save");
    tooltip("Save the chart or its values beside the document, or copy the values");
    if (ImGui::BeginPopup("save")) {
      for (const auto& [label, extension] : {std::pair{"Chart as SVG", ".svg"}, std::pair{"Chart as PNG", ".png"},
                                             std::pair{"Values as CSV", ".csv"}, std::pair{"Values as JSON", ".json"}})
        if (ImGui::MenuItem(label)) requests.emplace_back(SaveComparison{extension});
      if (ImGui::MenuItem("Copy values as CSV")) {
        ImGui::SetClipboardText(format_csv({.conditions = {}, .date = {}, .problems = {status.result->record}}).c_str());
        panels.show_toast("Copied " + count(static_cast<int>(status.result->record.rows.size()), "row"));
      }
      ImGui::EndPopup();
    }
    const Row* row = status.is_running ? nullptr : fastest(status.result->record, settings);
    const bool is_wanted = !status.is_running && std::exchange(panels.shown.takes_fastest, false);
    if (row == nullptr) {
      if (is_wanted) panels.show_toast("No method is stable here with an error below 10 %");
    } else {
      ImGui::SameLine();
      if (ImGui::Button("Fastest", {units(62.0), units(30.0)}) || (is_wanted && status.result->note != "Stopped.")) {
        use(*row, settings, requests);
        panels.show_toast("Fastest stable method: " + setting_text(*row, settings.frame_rate));
      }
      tooltip("Use the fastest with an error below 10 %: " + setting_text(*row, settings.frame_rate));
    }
  }
  if (close_button()) {
    panels.shown.comparison = false;
    requests.emplace_back(StopComparison{});
  }
}

}  // namespace

void build_comparison(const PanelInput& input, Panels& panels, Requests& requests) {
  if (!panels.shown.comparison) return;
  const Dock dock = dock_panel(input.layout, units(1.0), left_panel_width(input, panels, 600.0), 400.0);
  DockedPanel panel("comparison", dock, panels);
  strong_text("Compare methods on this scene");
  panel.begin_content();

  const ResultStatus<MethodComparison>& status = input.results.comparison;
  const bool has_rows = status.result && std::ranges::any_of(status.result->record.rows, is_drawn);
  if (status.is_running) {
    paragraph("Runs every method from the present state, on a copy, against a reference that two methods agree on.", palette::dim);
    // the reference takes longest, by a number of runs that is not known before
    const std::string elapsed = std::to_string(static_cast<int>(status.seconds));
    paragraph(status.fraction > 0.0 ? "Measuring the methods." : "Computing the reference, for " + elapsed + " s so far.", palette::dim);
    progress_bar(status.fraction, status.seconds, ImGui::GetContentRegionAvail().x);
  } else if (!status.result) {
    dim_text("Nothing compared yet.");
  }
  if (status.result && !status.result->note.empty()) paragraph(status.result->note, palette::warning);
  if (has_rows) {
    const float height = std::clamp(static_cast<float>(dock.place.height) - units(250.0), units(150.0), units(330.0));
    chart(input, *status.result, ImGui::GetContentRegionAvail().x, height, requests);
    legend(status.result->record);
    if (!status.is_running && status.result->note != "Stopped.") missing_methods(status.result->record);
  }
  panel.end_content();
  buttons(input, panels, requests);
}

}  // namespace hooke
