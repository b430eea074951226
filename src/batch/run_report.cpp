#include "batch/run_report.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "base/build_info.h"
#include "base/formatted.h"
#include "base/option_error.h"
#include "base/printable.h"
#include "base/text_lines.h"
#include "batch/accuracy_json.h"
#include "scene/parameter_value.h"
#include "sim/control/automatic.h"
#include "sim/methods/integrator.h"

namespace hooke {

using JsonLayout = JsonWriter::Layout;

// Size of the output buffer [bytes]: samples of large scenes are too large to keep in memory.
constexpr std::size_t max_buffered_bytes = 1 << 16;

namespace {

void write_choice(JsonWriter& json, const MethodChoice& choice, double allowed) {
  json.text("integrator", choice.method->id);
  json.integer("substeps", choice.substeps);
  json.integer("min_substeps", choice.min_substeps);
  json.number("ratio", choice.error ? std::optional(*choice.error / allowed) : std::nullopt);
}

// Null: the scene has no parts that it sets, or it is not given.
void write_value(JsonWriter& json, const Parameter& parameter, const Scene& scene) {
  json.key(parameter.name);
  const bool is_of_scene = parameter.scope == Parameter::Scope::Number || parameter.scope == Parameter::Scope::Setting;
  const bool is_known = (is_of_scene || parameter.applies == nullptr || parameter.applies(scene)) && parameter.is_given(scene);
  const double value = is_known ? parameter.read(scene) : 0.0;
  if (!is_known || !std::isfinite(value)) return json.null();
  if (&parameter == &dimensions_parameter) return json.integer(scene.system.dimensions);
  if (parameter.kind == Parameter::Kind::Choice) return json.raw(to_json(value_text(parameter, value)));
  if (parameter.kind == Parameter::Kind::Switch) return json.boolean(value != 0.0);
  json.number(value);
}

}  // namespace

std::string to_hexadecimal(std::uint64_t hash) { return formatted("%016llx", static_cast<unsigned long long>(hash)); }

std::optional<std::vector<Index>> parse_points(const std::optional<std::string>& list, Index count) {
  if (!list) return std::nullopt;
  std::vector<Index> points;
  for (const std::string_view word : split(*list, ',')) {
    points.push_back(parse_integer(word).value_or(no_index));
    if (points.back() < 0 || points.back() >= count)
      throw OptionError("points", printable(*list, 80),
                        count == 0 ? "must be left out: the scene has no points"
                                   : "must be numbers from 0 to " + std::to_string(count - 1) + ", separated by commas");
  }
  return points;
}

ComputedBy computed_by(const Execution& execution) {
  return {.precision = execution.single == nullptr ? "double" : "single", .device = execution.device == nullptr ? "cpu" : "gpu"};
}

JsonReport::JsonReport(const std::string& file, const std::string& scene_name, const Scene& scene, const ComputedBy& by) : file_(file) {
  json_.begin_object(JsonLayout::Lines);
  json_.text("version", program_version);
  json_.text("scene", scene_name);
  json_.integer("points", scene.system.point_count());
  json_.integer("springs", scene.system.spring_count());
  json_.text("integrator", scene.settings.integrator->id);
  json_.integer("substeps", scene.settings.substeps);
  if (is_automatic(scene.settings)) json_.number("tolerance", automatic_tolerance(scene.settings));
  allowed_error_ = automatic_tolerance(scene.settings) / scene.settings.frame_rate;
  json_.number("frame_rate", scene.settings.frame_rate);
  json_.text("precision", by.precision);
  json_.text("device", by.device);
  json_.begin_object("parameters", JsonLayout::Line);
  for (const Parameter& parameter : parameters()) write_value(json_, parameter, scene);
  json_.end();
  json_.begin_list("samples", JsonLayout::Lines);
}

void JsonReport::add_sample(const System& system, const State& state, const Accuracy& accuracy,
                            const std::optional<std::vector<Index>>& points) {
  const auto write_vectors = [&](const char* key, const std::vector<Vec3>& vectors) {
    json_.begin_list(key, JsonLayout::Line);
    const auto write = [&](std::size_t i) {
      i < vectors.size() ? json_.vector(vectors[i]) : json_.null();
      if (json_.written().size() > max_buffered_bytes) file_.write(json_.take());
    };
    if (points)
      for (const Index i : *points) write(static_cast<std::size_t>(i));
    else
      for (std::size_t i = 0; i < vectors.size(); ++i) write(i);
    json_.end();
  };
  json_.begin_object(JsonLayout::Line);
  json_.number("time", state.time);
  write_vectors("positions", state.position);
  write_vectors("velocities", state.velocity);

  const Energy energy = compute_energy(system, state);
  json_.begin_object("energy", JsonLayout::Line);
  json_.number("kinetic", energy.kinetic);
  json_.number("elastic", energy.elastic);
  json_.number("gravitational", energy.gravitational);
  json_.number("total", energy.total());
  json_.end();

  if (const auto& choice = state.memory.choice) {
    json_.begin_object("choice", JsonLayout::Line);
    write_choice(json_, *choice, allowed_error_);
    json_.end();
  }
  json_.key("error");
  write_error(json_, accuracy);
  json_.key("half_error");
  write_half_error(json_, accuracy);
  json_.key("energy_balance");
  write_energy_balance(json_, accuracy);
  json_.end();
  file_.write(json_.take());
}

void JsonReport::finish(const RunTotals& totals) {
  json_.end();
  json_.number("seconds", totals.seconds);
  json_.number("cpu_seconds", totals.cpu_seconds);
  json_.number("wall_seconds", totals.wall_seconds);
  json_.number("accuracy_cpu_seconds", totals.accuracy_cpu_seconds);
  json_.boolean("diverged", totals.diverged);
  json_.boolean("interrupted", totals.interrupted);
  if (totals.frames_beyond_tolerance) json_.integer("frames_beyond_tolerance", *totals.frames_beyond_tolerance);
  if (!totals.gas_releases.empty())
    json_.list("gas_releases", JsonLayout::Line, totals.gas_releases, [&](double time) { json_.number(time); });
  json_.integer("force_evaluations", totals.force_evaluations);
  json_.integer("factorizations", totals.factorizations);
  json_.text("hash", to_hexadecimal(totals.hash));
  json_.end();
  file_.write(json_.take() + "\n");
  file_.close();
}

CsvReport::CsvReport(const std::string& file, std::vector<Quantity> quantities) : file_(file), quantities_(std::move(quantities)) {
  file_.write(csv_heading(quantities_));
}

void CsvReport::add_sample(const System& system, const State& state, const Accuracy& accuracy) {
  file_.write(csv_row(quantities_, system, state, &accuracy));
}

namespace {

std::vector<Quantity> wanted_quantities(const std::optional<std::string>& list, const std::optional<std::vector<Index>>& points,
                                        const System& system) {
  std::vector<Quantity> quantities;
  if (list) {
    const std::string unknown = parse_quantities(*list, system.point_count(), system.spring_count(), quantities);
    if (!unknown.empty()) {
      const std::string in_range = names_in_range(unknown, system.point_count(), system.spring_count());
      throw OptionError("quantities", printable(unknown, 80),
                        in_range.empty() ? must_be_one_of(quantity_names(), unknown) : "must be " + in_range);
    }
    return quantities;
  }
  parse_quantities("time,kinetic,elastic,gravitational,total", system.point_count(), system.spring_count(), quantities);
  std::vector<Index> columns;
  if (points) {
    columns = *points;
  } else {
    columns.resize(static_cast<std::size_t>(system.point_count()));
    std::iota(columns.begin(), columns.end(), 0);
  }
  for (const Index i : columns)
    for (const char* component : {"x", "y", "z"})
      quantities.push_back(*find_quantity(component + std::to_string(i), system.point_count(), system.spring_count()));
  return quantities;
}

}  // namespace

RunOutput::RunOutput(const RunFiles& files, const std::string& scene_name, const Scene& scene,
                     const std::optional<std::vector<Index>>& points, const ComputedBy& by)
    : scene_(scene), points_(points), has_chosen_quantities_(files.quantities.has_value()) {
  if (files.json) json_.emplace(*files.json, scene_name, scene, by);
  if (files.csv) csv_.emplace(*files.csv, wanted_quantities(files.quantities, points, scene.system));
  if (files.pc2) pc2_.emplace(*files.pc2, scene.system.point_count());
}

RunHooks RunOutput::hooks() {
  RunHooks hooks;
  hooks.sample = [this](const State& state, const Accuracy& accuracy) {
    if (json_) json_->add_sample(scene_.system, state, accuracy, points_);
    if (csv_) csv_->add_sample(scene_.system, state, accuracy);
  };
  if (pc2_)
    hooks.frame = [this] {
      pc2_->add(scene_.state.position);
      return true;
    };
  return hooks;
}

void RunOutput::finish(const RunTotals& totals) {
  if (json_) json_->finish(totals);
  if (csv_) csv_->finish();
  if (pc2_) pc2_->close();
}

}  // namespace hooke
