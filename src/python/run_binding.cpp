#include <pybind11/stl.h>

#include <cstring>
#include <limits>
#include <numeric>

#include "batch/run_frames.h"
#include "batch/run_report.h"
#include "python/lab_binding.h"

namespace hooke::python {
namespace {

AccuracyMode mode_named(const std::string& name) {
  if (name == "off") return AccuracyMode::Off;
  if (name == "frame") return AccuracyMode::Frame;
  if (name == "full") return AccuracyMode::Full;
  throw UsageError("--accuracy " + name + ": must be one of off, frame, full");
}

// Arrays of all samples, filled in place while the run goes on.
class Samples {
 public:
  // Throws MemoryError if they do not fit.
  Samples(const Lab& lab, long count)
      : lab_(lab),
        points_(lab.scene().system.point_count()),
        positions_({static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(points_), py::ssize_t{3}}),
        velocities_({static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(points_), py::ssize_t{3}}),
        to_position_(positions_.mutable_data()),
        to_velocity_(velocities_.mutable_data()) {}

  void add(const State& state, const Accuracy& accuracy) {
    const std::size_t bytes = static_cast<std::size_t>(points_) * sizeof(Vec3);
    if (bytes > 0) {
      std::memcpy(to_position_, state.position.data(), bytes);
      std::memcpy(to_velocity_, state.velocity.data(), bytes);
    }
    to_position_ += 3 * static_cast<std::ptrdiff_t>(points_);
    to_velocity_ += 3 * static_cast<std::ptrdiff_t>(points_);
    time_.push_back(state.time);
    energy_.push_back(compute_energy(lab_.scene().system, state));
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
  Index points_;
  py::array_t<double> positions_, velocities_;
  double *to_position_, *to_velocity_;
  std::vector<double> time_;
  std::vector<Energy> energy_;
  std::vector<Accuracy> accuracy_;
};

py::tuple run(const NamedScene& scene, double seconds, std::optional<double> sample, const std::string& accuracy, const RunFiles& files,
              py::object on_frame, py::object progress) {
  NamedLab lab{scene.name, std::make_shared<Lab>(scene.scene(), KeepStart::No)};
  RunRequest request{.seconds = seconds, .sample = sample, .accuracy = mode_named(accuracy)};
  if (sample) check_option("--sample", *sample, positive);
  const double frame_rate = scene.scene().settings.frame_rate;
  // a run that diverges between two samples adds one
  Samples samples(*lab.lab, SampleClock::count(sample, frame_rate, count_frames(seconds, frame_rate)) + 1);

  std::vector<Index> points(scene.scene().system.points().size());
  std::iota(points.begin(), points.end(), 0);
  RunOutput output(files, scene.name, lab.lab->scene(), points);

  Watch watch(std::move(progress));
  RunHooks hooks = output.hooks();
  hooks.sample = [&, write = hooks.sample](const State& state, const Accuracy& measured) {
    samples.add(state, measured);
    write(state, measured);
  };
  if (!on_frame.is_none())
    hooks.frame = [&, write = hooks.frame] {
      if (write) write();
      const py::gil_scoped_acquire lock;
      const py::object answer = on_frame(lab);
      return !answer.is(py::bool_(false));
    };
  hooks.progress = [&](long done, long all) { watch.check(done, all); };
  RunResults results;
  {
    const py::gil_scoped_release unlocked;
    results = run_frames(*lab.lab, request, hooks);
    output.finish(results.totals);
  }
  py::dict entry = samples.take();
  const RunTotals& totals = results.totals;
  entry["seconds"] = totals.seconds;
  entry["cpu_seconds"] = totals.cpu_seconds;
  entry["wall_seconds"] = totals.wall_seconds;
  entry["accuracy_cpu_seconds"] = totals.accuracy_cpu_seconds;
  entry["diverged"] = totals.diverged;
  entry["force_evaluations"] = totals.force_evaluations;
  entry["factorizations"] = totals.factorizations;
  entry["hash"] = to_hexadecimal(totals.hash);
  entry["warnings"] = results.warnings;
  return py::make_tuple(entry, lab);
}

}  // namespace

void bind_run(py::module_& module) {
  module.def("run",
             [](const NamedScene& scene, double seconds, std::optional<double> sample, const std::string& accuracy,
                const std::optional<std::string>& json, const std::optional<std::string>& csv, const std::optional<std::string>& quantities,
                const std::optional<std::string>& pc2, py::object on_frame, py::object progress) {
               return run(scene, seconds, sample, accuracy, {.json = json, .csv = csv, .pc2 = pc2, .quantities = quantities},
                          std::move(on_frame), std::move(progress));
             });
}

}  // namespace hooke::python
