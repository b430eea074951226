#include <pybind11/stl.h>

#include <limits>
#include <numeric>
#include <span>

#include "batch/run_frames.h"
#include "batch/run_report.h"
#include "python/lab_binding.h"
#include "sim/adjoint/gradient.h"
#include "sim/model/hash.h"

namespace hooke::python {
namespace {

// Arrays of all samples, filled in place during the run.
class Samples {
 public:
  // Throws MemoryError if they do not fit.
  Samples(const Lab& lab, std::span<const Index> points, long count)
      : lab_(lab),
        points_(points),
        positions_({static_cast<py::ssize_t>(count), std::ssize(points_), py::ssize_t{3}}),
        velocities_({static_cast<py::ssize_t>(count), std::ssize(points_), py::ssize_t{3}}),
        to_position_(positions_.mutable_data()),
        to_velocity_(velocities_.mutable_data()) {}

  void add(const State& state, const Accuracy& accuracy) {
    for (const Index i : points_)
      for (int c = 0; c < 3; ++c) {
        *to_position_++ = state.position[i][c];
        *to_velocity_++ = state.velocity[i][c];
      }
    time_.push_back(state.time);
    energy_.push_back(lab_.energy());
    accuracy_.push_back(accuracy);
  }

  py::dict take() const {
    py::dict arrays;
    const py::slice recorded(py::int_(0), py::int_(time_.size()), py::int_(1));
    arrays["positions"] = positions_[recorded];
    arrays["velocities"] = velocities_[recorded];
    arrays["time"] = to_array(time_);
    arrays["kinetic"] = values([](const Energy& energy) { return energy.kinetic; });
    arrays["elastic"] = values([](const Energy& energy) { return energy.elastic; });
    arrays["gravitational"] = values([](const Energy& energy) { return energy.gravitational; });
    arrays["total"] = values([](const Energy& energy) { return energy.total(); });
    arrays["frame_error"] = measured([](const Accuracy& accuracy) { return accuracy.frame; });
    arrays["error"] = measured([](const Accuracy& accuracy) { return accuracy.accumulated; });
    arrays["amplification"] = measured([](const Accuracy& accuracy) { return accuracy.amplification; });
    return arrays;
  }

 private:
  template <class Read>
  py::array_t<double> values(Read read) const {
    std::vector<double> all;
    for (const Energy& energy : energy_) all.push_back(read(energy));
    return to_array(all);
  }
  // NaN: not known
  template <class Read>
  py::array_t<double> measured(Read read) const {
    std::vector<double> all;
    for (const Accuracy& accuracy : accuracy_) all.push_back(read(accuracy).value.value_or(std::numeric_limits<double>::quiet_NaN()));
    return to_array(all);
  }

  const Lab& lab_;
  std::span<const Index> points_;
  py::array_t<double> positions_, velocities_;
  double *to_position_, *to_velocity_;
  std::vector<double> time_;
  std::vector<Energy> energy_;
  std::vector<Accuracy> accuracy_;
};

// All of them, or those with these numbers.
std::vector<Index> points_of(const std::optional<std::vector<std::int64_t>>& numbers, Index count) {
  std::vector<Index> points(numbers ? numbers->size() : static_cast<std::size_t>(count));
  if (!numbers) std::iota(points.begin(), points.end(), 0);
  for (std::size_t i = 0; numbers && i < points.size(); ++i) {
    const std::int64_t number = (*numbers)[i];
    if (number < 0 || number >= count)
      throw OptionError("points", std::to_string(number), "must be the number of one of the " + std::to_string(count) + " points, from 0");
    points[i] = static_cast<Index>(number);
  }
  return points;
}

py::tuple run(const NamedScene& scene, double seconds, std::optional<double> sample, const std::string& accuracy, const RunFiles& files,
              const std::optional<std::vector<std::int64_t>>& sampled, std::int64_t threads, const std::string& precision,
              const std::string& device, py::object on_frame, py::object progress) {
  RunRequest request{.seconds = seconds, .sample = sample, .accuracy = accuracy_named(accuracy)};
  if (sample) check_option("sample", *sample, positive);
  if (files.quantities && !files.csv) throw UsageError("quantities: requires csv");
  require_separate_files(scene.name, {{"json", files.json}, {"csv", files.csv}, {"pc2", files.pc2}});
  const double frame_rate = scene.scene().settings.frame_rate;
  const long frames = count_frames(seconds, frame_rate);
  const auto lab = std::make_shared<NamedLab>(scene, KeepStart::No);
  lab->accuracy = accuracy;
  lab->lab.set_execution(execution_of(lab->lab, threads, precision, device));
  const std::vector<Index> points = points_of(sampled, scene.scene().system.point_count());
  // a run that ends between two samples adds one
  Samples samples(lab->lab, points, SampleClock::max_count(sample, frame_rate, frames) + 1);
  RunOutput output(files, scene.name, lab->lab.scene(), points, computed_by(lab->lab.plan().execution));
  const std::optional<std::string> coarse = output.warning();

  std::optional<Change> guard(*lab);
  lab->is_in_run = true;
  const std::shared_ptr<void> end(nullptr, [&](void*) { lab->is_in_run = false; });
  Watch watch(std::move(progress));
  const WatchedLab watched(lab->lab, watch);
  RunHooks hooks = output.hooks();
  hooks.sample = [&, write = hooks.sample](const State& state, const Accuracy& measured) {
    samples.add(state, measured);
    write(state, measured);
  };
  if (!on_frame.is_none())
    hooks.frame = [&, write = hooks.frame] {
      if (write) write();
      const py::gil_scoped_acquire lock;
      guard.reset();
      const bool should_continue = on_frame(lab).cast<bool>();
      guard.emplace(*lab);
      return should_continue;
    };
  hooks.progress = [&](long done, long all) { watch.check(done, all); };
  RunResults results;
  {
    const py::gil_scoped_release unlocked;
    results = run_frames(lab->lab, request, hooks);
    output.finish(results.totals);
  }
  if (coarse) results.warnings.push_back(*coarse);
  py::dict entry = samples.take();
  const RunTotals& totals = results.totals;
  entry["seconds"] = totals.seconds;
  entry["cpu_seconds"] = totals.cpu_seconds;
  entry["wall_seconds"] = totals.wall_seconds;
  entry["accuracy_cpu_seconds"] = totals.accuracy_cpu_seconds;
  entry["diverged"] = totals.diverged;
  entry["frames_beyond_tolerance"] = totals.frames_beyond_tolerance;
  entry["force_evaluations"] = totals.force_evaluations;
  entry["factorizations"] = totals.factorizations;
  entry["gas_releases"] = totals.gas_releases;
  entry["hash"] = to_hexadecimal(totals.hash);
  entry["warnings"] = results.warnings;
  return py::make_tuple(entry, lab);
}

// {"stiffness", ..., "velocities"} and the "hash" of the last state. `weights`: (samples, points, 3), or without samples.
py::dict gradient(const NamedScene& scene, long frames, std::vector<long> sampled, const Doubles& positions, const Doubles& velocities,
                  py::object progress) {
  const auto vectors = [](const Doubles& array) {
    return std::span(reinterpret_cast<const Vec3*>(array.data()), static_cast<std::size_t>(array.size()) / 3);
  };
  const SampleWeights weights{std::move(sampled), vectors(positions), vectors(velocities)};
  Gradient gradient;
  Watch watch(std::move(progress));
  {
    const py::gil_scoped_release unlocked;
    const Scene& start = scene.scene();
    gradient =
        compute_gradient(start.system, start.settings, start.state, frames, weights, [&](long done, long all) { watch.check(done, all); });
  }
  using namespace py::literals;
  return py::dict("stiffness"_a = to_array(gradient.stiffness), "rest_length"_a = to_array(gradient.rest_length),
                  "damping"_a = to_array(gradient.damping), "masses"_a = to_array(gradient.mass),
                  "positions"_a = to_array(gradient.position), "velocities"_a = to_array(gradient.velocity),
                  "hash"_a = to_hexadecimal(gradient.hash));
}

}  // namespace

void bind_run(py::module_& module) {
  module.def("gradient", &gradient);
  module.def("run",
             [](const NamedScene& scene, double seconds, std::optional<double> sample, const std::string& accuracy,
                const std::optional<std::string>& json, const std::optional<std::string>& csv, const std::optional<std::string>& quantities,
                const std::optional<std::string>& pc2, const std::optional<std::vector<std::int64_t>>& points, std::int64_t threads,
                const std::string& precision, const std::string& device, py::object on_frame, py::object progress) {
               return run(scene, seconds, sample, accuracy, {.json = json, .csv = csv, .pc2 = pc2, .quantities = quantities}, points,
                          threads, precision, device, std::move(on_frame), std::move(progress));
             });
}

}  // namespace hooke::python
