#include <pybind11/stl.h>

#include "batch/capture.h"
#include "lab/recording.h"
#include "python/scene_binding.h"
#include "python/turn.h"

namespace hooke::python {
namespace {

CaptureOptions capture_options(const std::string& out, const py::dict& options) {
  CaptureOptions parsed;
  parsed.out = out;
  const auto take = [&](const char* name, auto& field) {
    if (options.contains(name) && !options[name].is_none()) field = options[name].cast<std::remove_reference_t<decltype(field)>>();
  };
  take("seconds", parsed.seconds);
  take("frames", parsed.frames);
  take("fps", parsed.fps);
  take("size", parsed.size);
  take("scale", parsed.scale);
  take("ui", parsed.panels);
  take("report", parsed.report);
  take("stamp", parsed.stamp);
  take("fail_above", parsed.fail_above);
  take("camera", parsed.camera);
  if (parsed.seconds) check_option("seconds", *parsed.seconds, not_negative);
  if (parsed.frames) check_option("frames", static_cast<double>(*parsed.frames), {.min = 1, .max = 1e9});
  if (parsed.frames && parsed.seconds) throw UsageError("frames: excludes seconds");
  if (parsed.fps) check_option("fps", *parsed.fps, positive);
  check_option("scale", parsed.scale, {.min = 0.5, .max = 4.0});
  if (parsed.fail_above) check_option("fail-above", *parsed.fail_above, positive);
  return parsed;
}

Execution execution_from(const Lab& lab, const py::dict& options) {
  const std::int64_t threads = options.contains("threads") ? options["threads"].cast<std::int64_t>() : 1;
  return execution_of(lab, threads, "double", options.contains("device") ? options["device"].cast<std::string>() : "cpu");
}

// (diverged, the first frame beyond fail_above, the difference of a replay, the message of a divergence)
py::tuple capture(Lab& lab, const CaptureOptions& options, double length, const Scene* start, const py::object& progress) {
  // OpenGL's functions and the context of the panels belong to the process
  static Shared drawing;
  const Turn turn(drawing, "capture: is drawing: a force cannot draw another picture");
  Watch watch(progress);
  const WatchedLab watched(lab, watch);
  CaptureResults results;
  std::string message;
  {
    const py::gil_scoped_release unlocked;
    results = capture_frames(lab, options, length, [&](long done, long all) { watch.check(done, all); });
    if (results.diverged) message = explain_divergence(lab, start, results.seconds, [&] { watch.check(0, 0); });
  }
  return py::make_tuple(results.diverged, results.error_limit, lab.difference(), message);
}

py::tuple capture_scene(const NamedScene& scene, const std::string& out, const py::dict& options, const py::object& progress) {
  const CaptureOptions parsed = capture_options(out, options);
  Lab lab(scene.scene(), KeepStart::No);
  lab.set_execution(execution_from(lab, options));
  return capture(lab, parsed, 0.0, &scene.scene(), progress);
}

py::tuple capture_recording(const std::string& log, const std::string& out, const py::dict& options, const py::object& progress) {
  const CaptureOptions parsed = capture_options(out, options);
  const auto recording = std::make_shared<const Recording>(read_recording(log));
  Lab lab(*recording->start, KeepStart::No);
  lab.set_execution(execution_from(lab, options));
  lab.submit(Play{recording});
  lab.advance(0.0, [] { return true; });
  return capture(lab, parsed, static_cast<double>(recording->frames) / lab.scene().settings.frame_rate, nullptr, progress);
}

}  // namespace

void bind_capture(py::module_& module) {
  module.def("capture", &capture_scene);
  module.def("capture_recording", &capture_recording);
}

}  // namespace hooke::python
