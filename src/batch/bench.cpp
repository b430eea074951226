#include "batch/bench.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include "base/atomic_write.h"
#include "base/build_info.h"
#include "base/option_error.h"
#include "base/own_library.h"
#include "base/printable.h"
#include "base/read_file.h"
#include "batch/bench_report.h"
#include "batch/machine.h"
#include "batch/methods_page.h"
#include "batch/output_file.h"
#include "batch/run_report.h"
#include "formats/scene_file.h"
#include "scene/parameter_value.h"
#include "sim/control/automatic.h"
#include "sim/model/hash.h"
#include "study/work_precision_chart.h"

namespace hooke {
namespace {

// The part that the request measures, not complete yet.
PartRecord part_of(const BenchRequest& request) {
  PartRecord part{.number = request.shard.number, .count = request.shard.count};
  for (const Problem& problem : request.problems) part.of += problem.id + ' ';
  part.of += "by";
  for (const Integrator* method : request.methods) part.of += ' ' + std::string(method->id);
  return part;
}

// Hash of the file of the program or library: figures of different builds are not mixed.
std::string build() {
  const std::filesystem::path library = own_library();
  std::ifstream program(library.empty() ? "/proc/self/exe" : library, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(program), {});
  return to_hexadecimal(hash_bytes(bytes));
}

class Bench {
 public:
  Bench(const BenchRequest& request, const BenchHooks& hooks) : request_(request), hooks_(hooks) {
    results_.conditions = {program_version, build(), machine(), request.effort_name};
    if (!request_.folder) return;
    make_folder(*request_.folder);
    load_earlier_results();
  }

  BenchResults run() {
    const bool was_complete = std::exchange(part().is_complete, false);
    for (const Problem& problem : request_.problems) {
      if (!should_continue()) break;
      measure(problem);
    }
    const bool is_complete = part().is_complete = should_continue();
    // also where there was nothing to measure
    if (is_complete && (!was_complete || has_new_rows_)) save();
    return {std::move(results_), is_complete, has_failed_};
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool should_continue() const { return hooks_.should_continue() && !(request_.limit && Clock::now() - start_ > *request_.limit); }

  // Rows measured under the same conditions are not measured again.
  void load_earlier_results() {
    const std::filesystem::path file = *request_.folder / "bench.json";
    if (!std::filesystem::exists(file)) return;
    Results earlier = parse_results(read_file(file), printable(file.native()));
    if (earlier.conditions == results_.conditions)
      results_ = std::move(earlier);
    else
      hooks_.note(printable(file.native()) + ": from another build, machine or effort; measuring again");
  }

  PartRecord& part() {
    const PartRecord wanted = part_of(request_);
    for (PartRecord& known : results_.parts)
      if (known.is_same(wanted)) return known;
    return results_.parts.emplace_back(wanted);
  }

  ProblemRecord& find_or_add_record(const Problem& problem) {
    for (ProblemRecord& record : results_.problems)
      if (record.id == problem.id) {
        if (record.fingerprint != fingerprint(problem)) record = make_record(problem);
        return record;
      }
    return results_.problems.emplace_back(make_record(problem));
  }

  void measure(const Problem& problem) {
    std::vector<const Integrator*> methods;
    for (const Integrator* method : request_.methods)
      if (request_.shard.has(parts_++)) methods.push_back(method);
    if (methods.empty()) return;
    ProblemRecord& record = find_or_add_record(problem);
    PrecisionSweep sweep(problem, request_.effort, record);
    sweep.should_continue = [this] { return should_continue(); };
    sweep.row_done = [&] { hooks_.row_done(record.rows.back().setting); };
    for (const Integrator* method : methods) {
      hooks_.begin_part(problem.id + "  " + std::string(method->id));
      const std::size_t rows = record.rows.size();
      const bool finished = sweep.run(*method) && (request_.device == nullptr || sweep.run(*method, request_.device));
      const bool is_new = record.rows.size() > rows;
      hooks_.end_part(is_new);
      if (is_new) {
        has_new_rows_ = true;
        save();
      }
      if (!finished) break;
    }
    using enum ReferenceResult::Failure;
    if (sweep.reference_failure() != NotFinished && sweep.reference_failure() != Disagreement) return;
    hooks_.failure(problem.id + ": no reference, nothing measured: " + sweep.reference_failure_reason());
    has_failed_ = true;
  }

  void save() {
    if (has_new_rows_ || results_.date.empty()) results_.date = time_text("%Y-%m-%dT%H:%M:%SZ");
    if (request_.folder) save_results(results_, *request_.folder);
  }

  const BenchRequest& request_;
  const BenchHooks& hooks_;
  Results results_;
  std::size_t parts_ = 0;  // pairs of a problem and a method so far
  bool has_failed_ = false, has_new_rows_ = false;
  const Clock::time_point start_ = Clock::now();
};

}  // namespace

BenchResults run_bench(const BenchRequest& request, const BenchHooks& hooks) { return Bench(request, hooks).run(); }

MergedResults merge_benches(const std::vector<std::filesystem::path>& folders) {
  std::vector<std::pair<std::string, Results>> parts;
  for (const std::filesystem::path& folder : folders) {
    const std::filesystem::path file = folder / "bench.json";
    const std::string name = printable(file.native());
    parts.emplace_back(name, parse_results(read_file(file), name));
  }
  return merge_results(parts);
}

std::vector<Problem> default_problems(bool quick) {
  std::vector<Problem> chosen;
  for (const BuiltInProblem& row : built_in_problems())
    if (row.quick || !quick) chosen.push_back(row.make());
  return chosen;
}

Problem problem_named(const std::string& name) {
  if (const BuiltInProblem* row = find_problem(name)) return row->make();
  return make_problem(printable(std::filesystem::path(name).stem().native(), 80), load_scene(find_scene(name)).scene);
}

std::vector<const Integrator*> chosen_methods(const std::vector<std::string>& ids) {
  for (const std::string& id : ids)
    if (find_integrator(id) == nullptr)
      throw OptionError("methods", printable(id, 80), "no such method: " + must_be_one_of(ids_of_integrators(), id));
  std::vector<const Integrator*> chosen;
  for (const Integrator& method : integrators())
    if (ids.empty() || std::ranges::find(ids, method.id) != ids.end()) chosen.push_back(&method);
  if (std::ranges::find(ids, automatic_method().id) != ids.end()) chosen.push_back(&automatic_method());
  return chosen;
}

void write_pages(const Results& results, const std::filesystem::path& folder) {
  write_atomically(folder / "bench.md", markdown_report(results));
  write_atomically(folder / "methods.md", methods_page(results));
}

void save_results(const Results& results, const std::filesystem::path& folder) {
  make_folder(folder);
  write_atomically(folder / "bench.json", format_results(results));
  write_atomically(folder / "bench.csv", format_csv(results));
  write_pages(results, folder);
}

std::optional<std::string> draw_charts(const Results& results, const std::filesystem::path& folder) {
  for (const char* file : {"bench.svg", "bench.png"})
    if (std::optional<std::string> failure = draw_chart(work_precision_chart(results), folder / file)) return failure;
  return std::nullopt;
}

}  // namespace hooke
