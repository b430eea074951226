#include <pybind11/stl.h>

#include "base/errors.h"
#include "batch/bench.h"
#include "batch/check.h"
#include "formats/open_file.h"
#include "python/scene_binding.h"
#include "study/check_scene.h"
#include "study/hard_cases/case_report.h"

namespace hooke::python {
namespace {

BenchRequest bench_request(const std::vector<std::string>& methods, bool quick, std::optional<double> finest_error,
                           const std::string& shard, const std::optional<std::string>& folder) {
  BenchRequest request;
  request.shard = parse_shard(shard);
  request.methods = chosen_methods(methods);
  if (quick) {
    request.effort = quick_effort;
    request.effort_name = "quick";
    request.limit = quick_limit;
  }
  if (finest_error) {
    check_option("tolerance-range", *finest_error, positive);
    request.effort.finest_error = *finest_error;
    // results with another limit are not mixed
    request.effort_name += ", to " + format_exact(*finest_error);
  }
  if (folder) request.folder = *folder;
  return request;
}

// The results as JSON, whether they are complete, and messages.
py::tuple bench(const BenchRequest& request, const py::object& progress) {
  std::vector<std::string> messages;
  const long all = static_cast<long>(request.shard.count_of(request.problems.size() * request.methods.size()));
  long parts = 0;
  Watch watch(progress);
  BenchHooks hooks;
  hooks.should_continue = [&] {
    watch.check(parts, all);
    return true;
  };
  hooks.end_part = [&](bool) { ++parts; };
  hooks.failure = [&](const std::string& line) { messages.push_back(line); };
  hooks.note = hooks.failure;
  BenchResults results;
  {
    const py::gil_scoped_release unlocked;
    results = run_bench(request, hooks);
    if (request.folder)
      if (const auto failure = draw_charts(results.results, *request.folder)) messages.push_back(*failure);
  }
  watch.check(all, all);
  return py::make_tuple(format_results(results.results), results.is_complete, messages);
}

py::tuple bench_scene(const NamedScene& scene, const std::vector<std::string>& methods, bool quick, std::optional<double> finest_error,
                      const std::string& shard, const std::optional<std::string>& folder, const py::object& progress) {
  BenchRequest request = bench_request(methods, quick, finest_error, shard, folder);
  request.problems.push_back(make_problem(std::filesystem::path(scene.name).stem().string(), scene.scene()));
  return bench(request, progress);
}

py::tuple bench_names(const std::vector<std::string>& names, const std::vector<std::string>& methods, bool quick, const std::string& shard,
                      const std::optional<std::string>& folder, const py::object& progress) {
  BenchRequest request = bench_request(methods, quick, std::nullopt, shard, folder);
  if (names.empty()) request.problems = default_problems(quick);
  for (const std::string& name : names) request.problems.push_back(problem_named(name));
  return bench(request, progress);
}

py::tuple merge(const std::vector<std::string>& folders, const std::string& out) {
  const auto [results, missing] = merge_benches({folders.begin(), folders.end()});
  save_results(results, out);
  std::vector<std::string> messages;
  if (!missing.empty()) messages.push_back("incomplete: " + missing);
  if (const auto failure = draw_charts(results, out)) messages.push_back(*failure);
  return py::make_tuple(format_results(results), missing.empty(), messages);
}

std::optional<std::string> save_bench(const std::string& json, const std::string& folder) {
  const Results results = parse_results(json, "results");
  save_results(results, folder);
  return draw_charts(results, folder);
}

// (method, passed, measured) for each method of the scene's check.
py::list check(const NamedScene& scene) {
  // a copy: other threads may change the scene meanwhile
  const NamedScene checked = scene;  // NOLINT(performance-unnecessary-copy-initialization)
  Watch watch((py::none()));
  std::vector<CheckResult> results;
  {
    const py::gil_scoped_release unlocked;
    results = check_scene(checked.scene(), [&] { watch.check(); });
  }
  py::list rows;
  for (const CheckResult& result : results) rows.append(py::make_tuple(std::string(result.method->id), result.passed, result.measured));
  return rows;
}

// JSON, and the number of results that contradict what is expected.
py::tuple check_hard(const std::vector<int>& cases, const std::vector<std::string>& methods, bool quick, bool strict, int threads,
                     const py::object& progress) {
  constexpr int max_threads = 256;
  if (threads != 0) check_option("threads", threads, {.min = 1, .max = max_threads});
  const auto chosen = chosen_cases(cases);
  std::vector<CaseResult> results = list_cases(chosen, methods_for_cases(methods, quick), quick);
  if (results.empty()) throw UsageError("quick: excludes all of these cases");
  Watch watch(progress);
  // thrown only after the other threads have ended
  std::exception_ptr interrupt;
  {
    const py::gil_scoped_release unlocked;
    run_cases(results, threads > 0 ? threads : default_threads(), [&](long done, long all) {
      try {
        watch.check(done, all);
      } catch (...) {
        interrupt = std::current_exception();
      }
      return interrupt == nullptr;
    });
  }
  if (interrupt) std::rethrow_exception(interrupt);
  if (strict)
    for (CaseResult& result : results) result.verdict.expected = Expectation::Hold;
  return py::make_tuple(format_json(results), count_broken(results));
}

}  // namespace

void bind_study(py::module_& module) {
  module.def("bench_scene", &bench_scene);
  module.def("bench_names", &bench_names);
  module.def("merge_benches", &merge);
  module.def("save_bench", &save_bench);
  module.def("check", &check);
  module.def("check_hard", &check_hard);
  module.def("convert", [](const std::string& source, const std::string& target, const std::map<std::string, std::string>& options) {
    return convert_file(source, target, to_import_options(options)).warnings;
  });
}

}  // namespace hooke::python
