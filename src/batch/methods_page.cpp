#include "batch/methods_page.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/formatted.h"
#include "sim/methods/integrator.h"
#include "sim/plan/plan.h"

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

The limits above hold for small oscillations. Springs that rotate and stretch within a step can gain energy below the limit. The table counts
failures among 120 random nets that start stretched and rotating. The step is the limit divided by 1 to 4. A net fails if it diverges, or gains
more than 20 % of its energy in 3 s (version 1.1.0, `HOOKE_PRINT=1 build/release/tests/sim_test --gtest_filter='Margin.*'`).

| method | 1 | 1.5 | 2 | 3 | 4 |
|---|---|---|---|---|---|
| `symplectic_euler` | 60 | 5 | 3 | 0 | 0 |
| `velocity_verlet` | 31 | 5 | 0 | 0 | 0 |
| `blanes_moan4` | 6 | 2 | 0 | 0 | 0 |

Hooke recommends the limit divided by 4. No frequency describes a spring that passes through zero length, because its direction reverses
within the step. Failures among 2000 nets with random rest lengths, with the limit divided by 4, 8 and 16:

| method | 4 | 8 | 16 |
|---|---|---|---|
| `symplectic_euler` | 71 | 10 | 3 |
| `velocity_verlet` | 79 | 7 | 1 |
| `blanes_moan4` | 19 | 3 | 0 |

Where springs start with the energy to pass through zero length, Hooke recommends the limit divided by 16.

* The `forces` of the scene count in the limit. For wind, and for a pull to a center that grows faster than the distance, it is an estimate.
* A point that falls through the core of a pull to a center, or onto a plane that attracts, needs shorter steps. Hooke warns only of the core.
* Implicit methods leave out some derivatives of `forces`. Their limit is then 1 / omega of these forces.
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
            (method.is_symplectic() ? "; symplectic" : "") + " |\n";
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
          std::string(method.formula) + "\n```\n\n" + "* Source: " + std::string(method.source) + ".\n* Cost: " + std::string(method.cost) +
          ".\n* Stability: " + std::string(describe(method.stability)) + ".\n";
}

}  // namespace

std::string methods_page(const Results& results) {
  std::string text =
      "# Methods\n\n"
      "Formulas, limits, orders and costs of every method. [Accuracy](../evidence/accuracy.md) helps to choose one; [`auto`](auto.md) "
      "chooses by a\ntolerance. `scripts/accuracy` generates this page.\n\n"
      "A step goes from (x, v) to (x', v') in the time h. a is the acceleration by all forces, c the drag rate. k, d and l0 are "
      "stiffness,\n"
      "damping and rest length of a spring, u its direction. omega is the frequency of an undamped mode, lambda the rate of a "
      "dashpot.\n\n";
  add_summary(text);
  text += "\n## Order of convergence\n\n";
  add_orders(text);
  text +=
      "\nTests check these orders from both sides, for positions and velocities at steps of a given length. *Contact* is an impact of any "
      "restitution,\nor sliding without friction. A release from a `sticky` plane is of first order. The two limits of "
      "`velocity_verlet_explicit` act together:\n(h omega)^2 / 4 + h lambda < 1.\n";
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

}  // namespace hooke
