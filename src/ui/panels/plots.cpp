// The plots below the scene: quantities over time, one plot per unit.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "study/spectrum.h"
#include "ui/panels.h"
#include "ui/plot_axis.h"
#include "ui/text.h"
#include "ui/widgets.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

// Traces of the same unit.
struct Plot {
  std::string_view unit;
  std::vector<std::pair<const Trace*, ImU32>> lines;
};

std::vector<Plot> plots_of(const TraceTable& table) {
  std::vector<Plot> plots;
  for (const Trace& trace : table.traces) {
    auto plot = std::ranges::find(plots, trace.quantity.row->unit, &Plot::unit);
    if (plot == plots.end()) plot = plots.insert(plots.end(), {trace.quantity.row->unit, {}});
    plot->lines.emplace_back(&trace, palette::inks[plot->lines.size() % std::size(palette::inks)]);
  }
  return plots;
}

// The visible time span.
struct Span {
  double first, last;      // [s]
  std::size_t begin, end;  // samples within it and one more on each side
};

Span shown_span(const TraceTable& table, const Panels& panels) {
  const double newest = table.times.back(), oldest = table.times.front();
  const double length = std::max(1e-9, std::min(panels.plots.seconds, std::max(newest - oldest, 1e-9)));
  const double last = std::clamp(panels.plots.end.value_or(newest), oldest + length, newest);
  const auto from = std::ranges::lower_bound(table.times, last - length), to = std::ranges::upper_bound(table.times, last);
  const auto begin = static_cast<std::size_t>(from - table.times.begin()), end = static_cast<std::size_t>(to - table.times.begin());
  return {last - length, last, begin > 0 ? begin - 1 : 0, std::min(end + 1, table.times.size())};
}

PlotAxis axis_of_values(const Plot& plot, const Span& span) {
  double min = std::numeric_limits<double>::infinity(), max = -min;
  for (const auto& [trace, text_color] : plot.lines)
    for (std::size_t i = span.begin; i < span.end; ++i) {
      if (!std::isfinite(trace->values[i])) continue;
      min = std::min(min, trace->values[i]);
      max = std::max(max, trace->values[i]);
    }
  return fit_axis(min, max, 4);
}

// At most one pair of extremes per pixel, so that thousands of samples are drawn with hundreds of points. A line ends where the time jumps.
void draw_line(ImDrawList& list, const TraceTable& table, const Trace& trace, const Span& span, const PlotAxis& x_axis,
               const PlotAxis& y_axis, ImVec2 min, ImVec2 max, ImU32 text_color) {
  std::vector<ImVec2> points;
  const auto draw = [&] {
    list.AddPolyline(points.data(), static_cast<int>(points.size()), text_color, 0, units(1.6));
    points.clear();
  };
  for (std::size_t i = span.begin; i < span.end; ++i) {
    if (table.continues[i] == 0) draw();
    if (!std::isfinite(trace.values[i])) continue;
    const ImVec2 at{min.x + static_cast<float>(x_axis.fraction(table.times[i])) * (max.x - min.x),
                    max.y - static_cast<float>(y_axis.fraction(trace.values[i])) * (max.y - min.y)};
    if (points.size() >= 2 && std::floor(points[points.size() - 2].x) == std::floor(at.x)) {
      ImVec2 &low = points[points.size() - 2], &high = points.back();
      low.y = std::min({low.y, high.y, at.y});
      high.y = std::max(high.y, at.y);
      continue;
    }
    points.push_back(at);
  }
  draw();
}

// The accumulated error as a band about a coordinate of a point.
void draw_error_band(ImDrawList& list, const TraceTable& table, const Trace& trace, const Span& span, const PlotAxis& x_axis,
                     const PlotAxis& y_axis, ImVec2 min, ImVec2 max, ImU32 color) {
  const std::string_view name = trace.quantity.row->name;
  if (name != "x" && name != "y" && name != "z") return;
  const auto at = [&](std::size_t i, double side) {
    return ImVec2{min.x + static_cast<float>(x_axis.fraction(table.times[i])) * (max.x - min.x),
                  max.y - static_cast<float>(y_axis.fraction(trace.values[i] + side * table.errors[i])) * (max.y - min.y)};
  };
  const auto is_known = [&](std::size_t i) { return std::isfinite(trace.values[i]) && std::isfinite(table.errors[i]); };
  // one quadrangle per pixel at most
  const std::size_t step = 1 + (span.end - span.begin) / static_cast<std::size_t>(std::max(1.0f, max.x - min.x));
  for (std::size_t i = span.begin; i + step < span.end; i += step)
    if (is_known(i) && is_known(i + step))
      list.AddQuadFilled(at(i, 1.0), at(i + step, 1.0), at(i + step, -1.0), at(i, -1.0),
                         (color & ~IM_COL32_A_MASK) | IM_COL32(0, 0, 0, 60));
}

// A line at a time that is visible.
void draw_cursor(ImDrawList& list, const PlotAxis& x_axis, double time, ImVec2 min, ImVec2 max, ImU32 color) {
  const float x = min.x + static_cast<float>(x_axis.fraction(time)) * (max.x - min.x);
  if (x >= min.x && x <= max.x) list.AddLine({x, min.y}, {x, max.y}, color, units(1.0));
}

double time_under_mouse(const PlotAxis& x_axis, ImVec2 min, ImVec2 max) {
  return x_axis.min + (ImGui::GetIO().MousePos.x - min.x) / (max.x - min.x) * (x_axis.max - x_axis.min);
}

std::size_t sample_at(const TraceTable& table, double time) {
  const auto after = std::ranges::lower_bound(table.times, time);
  return std::min(static_cast<std::size_t>(after - table.times.begin()), table.times.size() - 1);
}

// The values of all traces at a time.
void show_readout(const TraceTable& table, const Plot& plot, double time, bool is_spectrum) {
  const std::size_t i = sample_at(table, time);
  std::string text = is_spectrum ? "f = " + quantity_text(table.times[i], "Hz") : "t = " + quantity_text(table.times[i], "s");
  for (const auto& [trace, text_color] : plot.lines)
    text += "\n" + trace->quantity.name() + " = " + quantity_text(trace->values[i], plot.unit);
  ImGui::SetTooltip("%s", text.c_str());
}

// A, then B; then both are removed.
void set_cursor(double time, PlotView& plots) {
  auto& [a, b] = plots.cursors;
  if (a && b)
    a = b = std::nullopt;
  else
    (a ? b : a) = time;
}

// Between the cursors: their distance as a period and a frequency, and the differences of the values.
void draw_difference(ImDrawList& list, const TraceTable& table, const Plot& plot, const PlotView& plots, ImVec2 min, ImVec2 max) {
  const auto& [a, b] = plots.cursors;
  if (!a || !b || *a == *b) return;
  std::string text = "B - A = " + quantity_text(*b - *a, "s") + "  (" + quantity_text(1.0 / std::abs(*b - *a), "Hz") + ")";
  for (const auto& [trace, color] : plot.lines)
    text += "\n" + trace->quantity.name() + ": " +
            quantity_text(trace->values[sample_at(table, *b)] - trace->values[sample_at(table, *a)], plot.unit);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at{max.x - size.x - units(8.0), std::max(min.y, max.y - size.y - units(6.0))};
  shaded_text(list, at, text, {5.0f, 3.0f});
}

// The highest peak of a spectrum.
void draw_peak(ImDrawList& list, const TraceTable& table, const Plot& plot, ImVec2 min, ImVec2 max) {
  std::vector<const Trace*> traces;
  for (const auto& [trace, color] : plot.lines) traces.push_back(trace);
  const auto frequency = peak_of(table, traces);
  if (!frequency) return;
  const std::string text = "peak at " + quantity_text(*frequency, "Hz") + ", period " + quantity_text(1.0 / *frequency, "s");
  list.AddText({max.x - ImGui::CalcTextSize(text.c_str()).x - units(8.0), min.y + units(4.0)}, palette::text, text.c_str());
}

// The wheel zooms the time axis, a drag moves it, a click goes to the time under the mouse, and with Shift it sets a cursor.
void handle_mouse(const TraceTable& table, const Span& span, double time, float width, Panels& panels, Requests& requests) {
  const ImGuiIO& io = ImGui::GetIO();
  const double length = span.last - span.first;
  if (ImGui::IsItemHovered() && io.MouseWheel != 0.0f) panels.plots.seconds = std::clamp(length * std::pow(0.8, io.MouseWheel), 1e-3, 1e9);
  constexpr double drag = 4.0;  // [design units]
  if (ImGui::IsItemActivated()) panels.plots.is_dragged = false;
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, units(drag))) panels.plots.is_dragged = true;
  if (ImGui::IsItemDeactivated() && !panels.plots.is_dragged) {
    if (io.KeyShift)
      set_cursor(time, panels.plots);
    else
      requests.emplace_back(Scrub{time});
  }
  if (!ImGui::IsItemActive() || !panels.plots.is_dragged || io.MouseDelta.x == 0.0f) return;
  const double end = span.last - io.MouseDelta.x / width * length;
  panels.plots.end = end < table.times.back() ? std::optional(end) : std::nullopt;
}

// [design units]: height of a line of names, their distance from their lines and from the next name
constexpr double name_line = 15.0, name_indent = 13.0, name_gap = 9.0;

// Of the names above a plot: so many lines as they need, if there is room for them.
int lines_of_names(const Plot& plot, float width, float height) {
  int lines = 1;
  float x = 0.0f;
  for (const auto& [trace, color] : plot.lines) {
    const float name = units(name_indent) + ImGui::CalcTextSize(trace->quantity.name().c_str()).x;
    if (x > 0.0f && x + name > width) x = 0.0f, ++lines;
    x += name + units(name_gap);
  }
  return std::clamp(static_cast<int>((height - units(90.0)) / units(name_line)), 1, lines);
}

// The names above the plot, each beside its color.
void draw_names(ImDrawList& list, const Plot& plot, ImVec2 at, float width, int lines) {
  float x = 0.0f, y = at.y;
  for (const auto& [trace, color] : plot.lines) {
    const std::string name = trace->quantity.name();
    const float size = units(name_indent) + ImGui::CalcTextSize(name.c_str()).x;
    if (x > 0.0f && x + size > width) {
      // the rest is in the readout under the mouse
      if (--lines == 0) return;
      x = 0.0f, y += units(name_line);
    }
    list.AddRectFilled({at.x + x, y + units(6.0)}, {at.x + x + units(9.0), y + units(9.0)}, color);
    list.AddText({at.x + x + units(name_indent), y}, palette::text, name.c_str());
    x += size + units(name_gap);
  }
}

void draw_plot(const PanelInput& input, const TraceTable& table, const Plot& plot, const Rect& place, int number_of_plot, Panels& panels,
               Requests& requests) {
  const bool is_spectrum = panels.plots.shows_spectrum;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float names_width = static_cast<float>(place.width) - units(66.0);
  const int names = lines_of_names(plot, names_width, static_cast<float>(place.height));
  const ImVec2 min{static_cast<float>(place.x) + units(56.0), static_cast<float>(place.y) + units(24.0 + (names - 1) * name_line)};
  const ImVec2 max{static_cast<float>(place.x + place.width) - units(10.0), static_cast<float>(place.y + place.height) - units(20.0)};
  if (max.x - min.x < units(40.0) || max.y - min.y < units(20.0)) return;
  const Span span = is_spectrum ? Span{0.0, table.times.back(), 0, table.times.size()} : shown_span(table, panels);
  const PlotAxis y_axis = axis_of_values(plot, span);
  PlotAxis x_axis = fit_axis(span.first, span.last, std::max(2, static_cast<int>((max.x - min.x) / units(70.0))));
  x_axis.min = span.first;
  x_axis.max = span.last;

  // the labels are in kJ where J would be long
  const UnitScale unit = unit_scale(std::max(std::abs(y_axis.min), std::abs(y_axis.max)), plot.unit);
  const PlotAxis labels{.min = y_axis.min / unit.factor, .max = y_axis.max / unit.factor, .step = y_axis.step / unit.factor};
  list.AddRectFilled(min, max, palette::box);
  for (const double tick : y_axis.ticks()) {
    const float y = max.y - static_cast<float>(y_axis.fraction(tick)) * (max.y - min.y);
    const std::string text = labels.label(tick / unit.factor);
    list.AddLine({min.x, y}, {max.x, y}, palette::line);
    list.AddText({min.x - units(6.0) - ImGui::CalcTextSize(text.c_str()).x, y - units(7.0)}, palette::dim, text.c_str());
  }
  for (const double tick : x_axis.ticks()) {
    const float x = min.x + static_cast<float>(x_axis.fraction(tick)) * (max.x - min.x);
    const std::string text = x_axis.label(tick) + (is_spectrum ? " Hz" : " s");
    list.AddLine({x, min.y}, {x, max.y}, palette::line);
    // the label of the last tick ends within the panel
    const float width = ImGui::CalcTextSize(text.c_str()).x, end = static_cast<float>(place.x + place.width) - units(2.0);
    list.AddText({std::min(x - 0.5f * width, end - width), max.y + units(4.0)}, palette::dim, text.c_str());
  }

  list.PushClipRect(min, max, true);
  for (const auto& [trace, color] : plot.lines) draw_error_band(list, table, *trace, span, x_axis, y_axis, min, max, color);
  for (const auto& [trace, text_color] : plot.lines) draw_line(list, table, *trace, span, x_axis, y_axis, min, max, text_color);
  list.PopClipRect();
  if (is_spectrum) {
    draw_peak(list, table, plot, min, max);
  } else {
    draw_cursor(list, x_axis, input.status.snapshot->state.time, min, max, palette::text);
    if (panels.plots.time_under_mouse) draw_cursor(list, x_axis, *panels.plots.time_under_mouse, min, max, palette::dim);
    for (const auto& cursor : panels.plots.cursors)
      if (cursor) draw_cursor(list, x_axis, *cursor, min, max, palette::accent);
    draw_difference(list, table, plot, panels.plots, min, max);
  }

  // the unit above the axis
  const float names_y = static_cast<float>(place.y) + units(6.0);
  list.AddText({static_cast<float>(place.x) + units(10.0), names_y}, palette::dim, ("[" + unit.unit + "]").c_str());
  draw_names(list, plot, {min.x, names_y}, names_width, names);

  ImGui::SetCursorScreenPos(min);
  ImGui::PushID(number_of_plot);
  ImGui::InvisibleButton("plot", {max.x - min.x, max.y - min.y});
  ImGui::PopID();
  const double time = time_under_mouse(x_axis, min, max);
  if (!is_spectrum) handle_mouse(table, span, time, max.x - min.x, panels, requests);
  if (!ImGui::IsItemHovered()) return;
  if (!is_spectrum) panels.plots.next_time_under_mouse = time;
  show_readout(table, plot, time, is_spectrum);
}

void buttons(const PanelInput& input, const Rect& place, Panels& panels, Requests& requests) {
  const float x = static_cast<float>(place.x) + units(6.0), width = units(68.0);
  float y = static_cast<float>(place.y) + units(8.0);
  const auto button = [&](const char* name, const char* hint) {
    ImGui::SetCursorScreenPos({x, y});
    const bool clicked = ImGui::Button(name, {width, units(24.0)});
    tooltip(hint);
    y += units(29.0);
    return clicked;
  };
  if (button("Choose", "Choose what to plot")) ImGui::OpenPopup("choose");
  const bool held = panels.plots.end.has_value();
  if (button(held ? "Follow" : "Hold", held ? "Follow the newest time" : "Keep the visible time span")) {
    if (held || input.status.timeline.traces->times.empty())
      panels.plots.end.reset();
    else
      panels.plots.end = input.status.timeline.traces->times.back();
  }
  if (button("All", "Show the whole time span. The mouse wheel zooms, Shift+click sets two cursors")) {
    panels.plots.seconds = 1e9;
    panels.plots.end.reset();
  }
  bool& spectrum = panels.plots.shows_spectrum;
  if (button(spectrum ? "Times" : "Spectrum", spectrum ? "Show the values over time" : "Show the frequencies in the visible time span"))
    spectrum = !spectrum;
  if (ImGui::BeginPopup("choose")) {
    build_plot_choices(input, requests);
    close_on_escape(input, panels);
    ImGui::EndPopup();
  }
}

}  // namespace

std::pair<double, double> shown_times(const TraceTable& table, const Panels& panels) {
  const Span span = shown_span(table, panels);
  return {span.first, span.last};
}

std::vector<Quantity> plotted(const DocumentStatus& document, const System& system) {
  static const std::vector<std::string> energies = {"kinetic", "elastic", "gravitational", "total"};
  std::vector<Quantity> quantities;
  for (const std::string& name : document.view.plots.empty() ? energies : document.view.plots)
    if (const auto quantity = find_quantity(name, system.point_count(), system.spring_count())) quantities.push_back(*quantity);
  return quantities;
}

void build_plots(const PanelInput& input, Panels& panels, Requests& requests) {
  const Rect& dock = input.layout.plots;
  if (dock.height <= 0.0) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
  begin_panel("plots", dock, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  ImGui::GetWindowDrawList()->AddLine(corner(dock), {static_cast<float>(dock.x + dock.width), static_cast<float>(dock.y)}, palette::line);
  ImGui::PushFont(fonts().small);
  buttons(input, dock, panels, requests);

  const TraceTable& times = *input.status.timeline.traces;
  SpectrumOfPlots& spectrum = panels.plots.spectrum;
  if (!panels.plots.shows_spectrum || times.times.empty()) {
    spectrum = {};
  } else if (const auto span = shown_times(times, panels); spectrum.traces != input.status.timeline.traces || spectrum.span != span) {
    spectrum = {input.status.timeline.traces, span, spectrum_of(times, span.first, span.second)};
  }
  const TraceTable& table = panels.plots.shows_spectrum ? spectrum.table : times;
  const std::vector<Plot> plots = plots_of(table);
  const double left = dock.x + units(78.0), width = dock.width - units(78.0);
  if (table.times.empty() || plots.empty()) {
    ImGui::SetCursorScreenPos({static_cast<float>(left) + units(12.0), static_cast<float>(dock.y) + units(12.0)});
    paragraph(times.traces.empty() ? "Choose what to plot" : "Press Space to run the scene", palette::dim);
  }
  for (std::size_t i = 0; i < plots.size() && !table.times.empty(); ++i) {
    const double fraction = width / static_cast<double>(plots.size());
    draw_plot(input, table, plots[i], {left + static_cast<double>(i) * fraction, dock.y, fraction, dock.height}, static_cast<int>(i),
              panels, requests);
  }
  ImGui::PopFont();
  ImGui::End();
}

}  // namespace hooke
