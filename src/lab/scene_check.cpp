#include "lab/scene_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "lab/file_limits.h"
#include "lab/json_text.h"
#include "lab/lab.h"
#include "lab/quantity.h"
#include "lab/run_books.h"
#include "sim/divergence.h"

namespace hooke {

// A quantity at the ends of frames, from the law's `from` on; never empty.
struct Series {
  std::vector<double> time, value;
};

// What a law of this kind asks for, and how it is judged. The figure is what is compared: with `value`, or with the limits.
struct LawKind {
  std::string_view id;
  bool has_value, has_limits;  // must give value and within; least or most
  double (*figure)(const Series& series);
  std::string_view words;  // "the total FIGURE"
};

namespace {

double largest_change(const Series& s) {
  double most = 0.0;
  for (const double v : s.value) most = std::max(most, std::abs(v - s.value.front()));
  return most;
}

double largest_rise(const Series& s) {
  double least = s.value.front(), most = 0.0;
  for (const double v : s.value) {
    least = std::min(least, v);
    most = std::max(most, v - least);
  }
  return most;
}

double last(const Series& s) { return s.value.back(); }
double peak(const Series& s) { return *std::ranges::max_element(s.value); }
double trough(const Series& s) { return *std::ranges::min_element(s.value); }

// Mean time between passings upwards through the middle between its extremes, each where a line between two frames crosses it.
double period(const Series& s) {
  const double middle = 0.5 * (peak(s) + trough(s));
  double first = NAN, latest = NAN;
  int passings = 0;
  for (std::size_t i = 1; i < s.value.size(); ++i) {
    const double before = s.value[i - 1] - middle, after = s.value[i] - middle;
    if (!(before < 0.0 && after >= 0.0)) continue;
    latest = s.time[i - 1] + (s.time[i] - s.time[i - 1]) * before / (before - after);
    if (passings++ == 0) first = latest;
  }
  return passings > 1 ? (latest - first) / (passings - 1) : NAN;
}

constexpr std::array kinds{
    LawKind{"constant", false, false, largest_change, "changes by"},
    LawKind{"never_rises", false, false, largest_rise, "rises by"},
    LawKind{"ends_at", true, false, last, "ends at"},
    LawKind{"peaks_at", true, false, peak, "peaks at"},
    LawKind{"period", true, false, period, "has the period"},
    LawKind{"between", false, true, nullptr, "goes"},
};

std::string figure_text(double figure) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", figure);
  return text;
}

// What is known of how far the run may be trusted.
std::string describe_trust(const RunBooks& books, const System& system) {
  char text[80];
  std::snprintf(text, sizeof text, "; errors of %.1g m in all, as estimated", books.estimated_error());
  std::string trust = text;
  for (const std::string& doubt : books.doubts(system, {})) trust += "; " + doubt;
  return trust;
}

struct Verdict {
  bool holds;
  std::string words;
};

Verdict judge(const Law& law, const Series& series) {
  const std::string what = law.of + " " + std::string(law.kind->words) + " ";
  if (law.kind->has_limits) {
    const double low = trough(series), high = peak(series);
    const bool holds = (!law.least || low >= *law.least) && (!law.most || high <= *law.most);
    return {holds, what + "from " + figure_text(low) + " to " + figure_text(high) + " (" + (law.least ? figure_text(*law.least) : "") +
                       ".." + (law.most ? figure_text(*law.most) : "") + ")"};
  }
  const double figure = law.kind->figure(series), wanted = law.value.value_or(0.0);
  const std::string target = law.kind->has_value ? figure_text(wanted) + " +- " : "at most ";
  return {std::abs(figure - wanted) <= *law.within, what + figure_text(figure) + " (" + target + figure_text(*law.within) + ")"};
}

// The quantities of the laws, frame by frame.
class Record {
 public:
  Record(const SceneCheck& check, const Scene& scene) : check_(check), start_(scene.state.time), series_(check.laws.size()) {
    for (const Law& law : check.laws) quantities_.push_back(find_quantity(law.of, scene.system.point_count(), scene.system.spring_count()));
  }
  void add(const Scene& scene) {
    if (check_.laws.empty()) return;
    const Measured measured = measure(scene.system, scene.state);
    for (std::size_t i = 0; i < series_.size(); ++i) {
      if (!quantities_[i] || scene.state.time - start_ < check_.laws[i].from) continue;
      series_[i].time.push_back(scene.state.time);
      series_[i].value.push_back(quantities_[i]->of(measured));
    }
  }
  Verdict judge_all() const {
    Verdict all{true, ""};
    for (std::size_t i = 0; i < series_.size(); ++i) {
      const Verdict one =
          series_[i].value.empty() ? Verdict{false, check_.laws[i].of + ": nothing to measure"} : judge(check_.laws[i], series_[i]);
      all.holds = all.holds && one.holds;
      all.words += (all.words.empty() ? "" : "; ") + std::string(one.holds ? "" : "NOT SO: ") + one.words;
    }
    return all;
  }

 private:
  const SceneCheck& check_;
  double start_;
  std::vector<std::optional<Quantity>> quantities_;
  std::vector<Series> series_;
};

CheckResult run(const SceneCheck& check, Scene scene, const CheckedMethod& checked) {
  const Integrator& method = *checked.method;
  scene.settings.integrator = &method;
  if (checked.substeps) scene.settings.substeps = *checked.substeps;
  if (method.stability != Stability::Adaptive) scene.settings.tolerance.reset();
  const long frames = std::lround(std::ceil(check.seconds * scene.settings.frame_rate));
  Lab lab(std::move(scene), KeepStart::No);
  Record record(check, lab.scene());
  record.add(lab.scene());
  constexpr int frames_per_estimate = 20;
  RunBooks books(lab.scene().system, lab.scene().state, check.stops ? 0 : frames_per_estimate);
  for (long frame = 0; frame < frames; ++frame) {
    books.begin_frame(lab.scene().system, lab.scene().settings, lab.scene().state);
    if (lab.step()) {
      books.end_frame(lab.scene().system, lab.scene().state, lab.last_frame().motion());
      record.add(lab.scene());
      continue;
    }
    lab.publish();
    const Status& status = *lab.status();
    const bool open = status.snapshot->divergence && !status.message.empty() && status.advice && is_finite(lab.scene().state);
    return {&method, open && check.stops, status.message};
  }
  if (check.stops) return {&method, false, "it was to be stopped by the watch, and ran on"};
  const Verdict verdict = record.judge_all();
  return {&method, verdict.holds && is_finite(lab.scene().state),
          (verdict.words.empty() ? "runs to its end" : verdict.words) + describe_trust(books, lab.scene().system)};
}

const LawKind& read_kind(const JsonField& field) {
  std::string ids;
  for (const LawKind& kind : kinds) {
    if (field.text() == kind.id) return kind;
    ids += (ids.empty() ? "" : ", ") + std::string(kind.id);
  }
  field.refuse("must be one of " + ids);
}

Law read_law(const JsonField& field) {
  Law law;
  for (const JsonField member : field.members()) {
    if (member.is("law"))
      law.kind = &read_kind(member);
    else if (member.is("of"))
      law.of = member.text();
    else if (member.is("value"))
      law.value = member.number();
    else if (member.is("within"))
      law.within = member.number(not_negative);
    else if (member.is("least"))
      law.least = member.number();
    else if (member.is("most"))
      law.most = member.number();
    else if (member.is("from"))
      law.from = member.number(not_negative);
    else
      member.refuse("must be law, of, value, within, least, most or from");
  }
  if (law.kind == nullptr) field.refuse_missing("law", "must be given");
  // whatever there may be: numbers of points and springs are not known yet
  constexpr Index many = std::numeric_limits<Index>::max();
  if (!find_quantity(law.of, many, many)) field.refuse("must have \"of\", one of " + quantity_names());
  if (law.kind->has_limits ? !law.least && !law.most : !law.within)
    field.refuse(law.kind->has_limits ? "must have least or most" : "must have within");
  if (law.kind->has_value && !law.value) field.refuse_missing("value", "must be a number");
  return law;
}

// "velocity_verlet", or {"method": "baraff_witkin", "substeps": 2}
CheckedMethod read_method(const JsonField& field) {
  CheckedMethod checked;
  const auto set_id = [&](const JsonField& id) {
    checked.method = find_integrator(id.text());
    if (checked.method == nullptr) id.refuse("must be a method's id");
  };
  if (!field.is_object()) {
    set_id(field);
    return checked;
  }
  for (const JsonField member : field.members()) {
    if (member.is("method"))
      set_id(member);
    else if (member.is("substeps"))
      checked.substeps = static_cast<int>(member.whole(1, most_substeps));
    else
      member.refuse("must be method or substeps");
  }
  if (checked.method == nullptr) field.refuse_missing("method", "must be a method's id");
  return checked;
}

}  // namespace

SceneCheck read_scene_check(const JsonField& field) {
  constexpr std::size_t most_laws = 100;
  SceneCheck check;
  for (const JsonField member : field.members()) {
    if (member.is("seconds"))
      check.seconds = member.number({.least = 0.0, .most = 1e4});
    else if (member.is("stops"))
      check.stops = member.boolean();
    else if (member.is("methods"))
      for (const JsonField item : member.items(0, most_laws)) check.methods.push_back(read_method(item));
    else if (member.is("laws"))
      for (const JsonField item : member.items(0, most_laws)) check.laws.push_back(read_law(item));
    else
      member.refuse("must be seconds, methods, laws or stops");
  }
  return check;
}

SceneCheck check_of(const Scene& scene) {
  SceneCheck check;
  if (!scene.kept.check.empty()) {
    JsonParser parser;
    const std::string name = "check";
    check = read_scene_check({name, name, parser.parse(scene.kept.check)});
  }
  if (check.methods.empty()) check.methods.push_back({scene.settings.integrator, std::nullopt});
  return check;
}

std::vector<CheckResult> check_scene(const Scene& scene) {
  const SceneCheck check = check_of(scene);
  std::vector<CheckResult> results;
  for (const CheckedMethod& method : check.methods) results.push_back(run(check, scene, method));
  return results;
}

}  // namespace hooke
