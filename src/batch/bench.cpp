#include "batch/bench.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "base/atomic_write.h"
#include "base/build_info.h"
#include "base/formatted.h"
#include "base/option_error.h"
#include "base/own_library.h"
#include "base/printable.h"
#include "base/read_file.h"
#include "batch/bench_report.h"
#include "batch/machine.h"
#include "batch/output_file.h"
#include "batch/run_report.h"
#include "formats/scene_file.h"
#include "scene/parameter_value.h"
#include "sim/control/automatic.h"
#include "sim/methods/integrator.h"
#include "sim/model/hash.h"
#include "sim/plan/plan.h"
#include "study/work_precision_chart.h"
#include "study/work_precision_file.h"

namespace hooke {
namespace {

// Relative errors at which methods are compared: visually acceptable, for measurements, small.
constexpr std::array decades{2, 4, 8};

// The cheapest row of a method, or null.
const Row* cheapest_of(const ProblemRecord& record, std::string_view method, double error) {
  const Row* best = nullptr;
  for (const Row& row : record.rows) {
    const auto known = error_with_uncertainty(record, row);
    if (row.method != method || !known || *known > error || !row.cpu_ms_per_s) continue;
    if (best == nullptr || *row.cpu_ms_per_s < *best->cpu_ms_per_s) best = &row;
  }
  return best;
}

constexpr std::string_view recommended_step = R"(
## Linear limit and recommended step

The limits above hold for small oscillations. Springs that rotate and stretch within a step can gain energy below them. Of 120 random nets
that start stretched and rotating, as many diverge or gain more than 20 % of their energy in 3 s, with steps shorter than the limit by a
factor of (version 1.1.0, `HOOKE_PRINT=1 build/release/tests/sim_test --gtest_filter='Margin.*'`)

| method | 1 | 1.5 | 2 | 3 | 4 |
|---|---|---|---|---|---|
| `symplectic_euler` | 60 | 5 | 3 | 0 | 0 |
| `velocity_verlet` | 31 | 5 | 0 | 0 | 0 |
| `blanes_moan4` | 6 | 2 | 0 | 0 | 0 |

Hooke recommends the limit divided by 4. No frequency describes a spring that passes through zero length, because its direction reverses
within the step. Of 2000 nets with random rest lengths, as many fail:

| method | 4 | 8 | 16 |
|---|---|---|---|
| `symplectic_euler` | 71 | 10 | 3 |
| `velocity_verlet` | 79 | 7 | 1 |
| `blanes_moan4` | 19 | 3 | 0 |

Where springs start with the energy to pass through zero length, Hooke recommends the limit divided by 16.

Listed forces count in the limit. For wind, and for a pull to a center that grows faster than the distance, it is an estimate. A point that
falls through the core of a pull to a center, or onto a plane that attracts, needs shorter steps; the warning before a run counts those
of a core.
Implicit methods leave out some derivatives of listed forces; the limit is then 1 / omega of these.
)";

std::string limit_of(const Integrator& method, const Spectrum& spectrum, const char* rate) {
  const double limit = StepLimits(spectrum).stable_step(method);
  if (limit == 0.0) return "none";
  return std::isinf(limit) ? "any" : std::string("h ") + rate + " < " + formatted("%.3g", limit);
}

// Wind and mass_center are the listed forces that depend on velocity.
void add_orders(std::string& text) {
  text +=
      "| method | undamped | `drag` | dashpots | contact | friction | `wind` | `mass_center` |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const Integrator& method : integrators()) {
    text += "| `" + std::string(method.id) + "` |";
    for (const int order : {method.order, method.order_with.drag, method.order_with.damped, method.order_with.contact, friction_order,
                            method.order_with.force_terms, method.order_with.force_terms})
      text += " " + std::to_string(order) + " |";
    text += "\n";
  }
}

void add_summary(std::string& text) {
  text += "| method | undamped modes | dashpots alone | energy, undamped |\n|---|---|---|---|\n";
  for (const Integrator& method : integrators()) {
    text += "| [`" + std::string(method.id) + "`](#" + std::string(method.id) + ") | " + limit_of(method, {.omega = 1.0}, "omega") + " | " +
            limit_of(method, {.dashpot_rate = 1.0}, "lambda") + " | " + std::string(describe(method.energy)) +
            (method.symplectic ? "; symplectic" : "") + " |\n";
  }
}

bool is_measured(const Integrator& method, const Results& results) {
  const auto is_of_method = [&](const Row& row) { return row.method == method.id; };
  return std::ranges::any_of(results.problems, [&](const ProblemRecord& record) { return std::ranges::any_of(record.rows, is_of_method); });
}

// The cost of each method that was measured to reach a decade of error, as a multiple of the cheapest.
void add_comparison(std::string& text, const Results& results, int decade) {
  text += "\n### To an error of 1e-" + std::to_string(decade) + "\n\n| problem | cheapest [ms/s] |";
  std::string line = "|---|---|";
  for (const Integrator& method : integrators()) {
    if (!is_measured(method, results)) continue;
    text += " `" + std::string(method.id) + "` |";
    line += "---|";
  }
  text += "\n" + line + "\n";
  for (const ProblemRecord& record : results.problems) {
    const double error = std::pow(10.0, -decade);
    const Row* best = cheapest(record, error);
    const char* none = is_measurable(record, error) ? "not reached" : "not measurable";
    text += "| " + record.id + " | " + (best ? formatted("%.3g", *best->cpu_ms_per_s) : none) + " |";
    for (const Integrator& method : integrators()) {
      if (!is_measured(method, results)) continue;
      const Row* row = best ? cheapest_of(record, method.id, error) : nullptr;
      text += row == nullptr ? " - |" : row == best ? " **1** |" : " " + formatted("%.2g", *row->cpu_ms_per_s / *best->cpu_ms_per_s) + " |";
    }
    text += "\n";
  }
}

void add_method(std::string& text, const Integrator& method) {
  text += "\n## " + std::string(method.id) + "\n\n**" + std::string(method.label) + ".** " + std::string(method.summary) + "\n\n```\n" +
          std::string(method.formula) + "\n```\n\n" + "* Source: " + std::string(method.source) + ".\n* Costs " + std::string(method.cost) +
          ".\n* Stability: " + std::string(describe(method.stability)) + ".\n";
}

// docs/reference/methods.md: every method, from its row in the table and its benchmark results.
std::string methods_page(const Results& results) {
  std::string text =
      "# Methods\n\n"
      "Generated by `scripts/accuracy` from the table of methods and the benchmark results; do not edit it. "
      "[Accuracy](../evidence/accuracy.md)\n"
      "says which method to choose when; [`auto`](auto.md) chooses by a tolerance.\n\n"
      "One step goes from (x, v) to (x', v') in the time h. a is the acceleration by all forces, c the drag rate. k, d and l0 are "
      "stiffness,\n"
      "damping and rest length of a spring, u its direction. omega is the frequency of an undamped mode, lambda the rate of a dashpot. "
      "Orders\n"
      "are those of positions and velocities; tests reject lower and higher ones.\n\n";
  add_summary(text);
  text += "\n## Order of convergence\n\n";
  add_orders(text);
  text +=
      "\nContact is an impact of any restitution, and sliding without friction. The orders are those of steps of a given length. A release "
      "from a\n"
      "`sticky` plane is of first order. Of `velocity_verlet_explicit` both limits act together: (h omega)^2 / 4 + h lambda < 1.\n";
  text += recommended_step;
  text +=
      "\n## Measured\n\nCPU time of each method to reach an error, as a multiple of that of the cheapest method. Errors are relative to "
      "the "
      "size of the\nscene; `-`: no tested setting reaches it. Measured " +
      results.date.substr(0, 10) + " with Hooke " + results.conditions.version + ", on one thread of " + results.conditions.machine + ".\n";
  for (const int decade : decades) add_comparison(text, results, decade);
  for (const Integrator& method : integrators()) add_method(text, method);
  return text;
}

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
