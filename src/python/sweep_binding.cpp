#include <pybind11/stl.h>

#include "base/atomic_write.h"
#include "batch/sweep/run_sweep.h"
#include "batch/sweep/sweep_report.h"
#include "python/scene_binding.h"

namespace hooke::python {
namespace {

// The table as CSV and as JSON, whether it is complete, and why there are no charts.
py::tuple sweep(const NamedScene& scene, const std::vector<std::string>& vary, const std::string& measures, double seconds,
                const std::string& shard, const std::optional<std::string>& folder, const py::object& progress) {
  if (folder && has_force_callback(scene.scene())) throw InputError("out: a Python function cannot be written to a file");
  SweepRequest request{.scene = scene.scene(), .sweep = {}, .shard = parse_shard(shard), .folder = folder};
  request.sweep = make_sweep(scene.name, request.scene, vary, measures, seconds);
  long done = 0, all = 0;
  Watch watch(progress);
  SweepHooks hooks;
  hooks.should_continue = [&] {
    watch.check(done, all);
    return true;
  };
  hooks.progress = [&](long now, long of) {
    done = now;
    all = of;
    watch.check(done, all);
  };
  std::optional<std::string> failure;
  std::string csv, json;
  bool is_complete = false;
  {
    const py::gil_scoped_release unlocked;
    const SweepResults results = run_sweep(request, hooks);
    is_complete = results.is_complete();
    if (folder && is_complete) failure = draw_sweep_charts(results, *folder);
    csv = format_sweep_csv(results.sweep, results.rows);
    json = format_sweep_json(results.sweep, results.rows);
  }
  return py::make_tuple(csv, json, is_complete, failure);
}

// The same of the parts in these folders, merged into `folder`.
py::tuple merge_parts(const std::vector<std::string>& parts, const std::string& folder) {
  const SweepResults results = merge_sweeps({parts.begin(), parts.end()}, folder);
  const auto failure = results.is_complete() ? draw_sweep_charts(results, folder) : std::nullopt;
  return py::make_tuple(format_sweep_csv(results.sweep, results.rows), format_sweep_json(results.sweep, results.rows),
                        results.is_complete(), failure);
}

}  // namespace

void bind_sweep(py::module_& module) {
  module.def("sweep", &sweep);
  module.def("merge_sweeps", &merge_parts);
  module.def("write_text", [](const std::string& file, const std::string& text) { write_atomically(file, text); });
}

}  // namespace hooke::python
