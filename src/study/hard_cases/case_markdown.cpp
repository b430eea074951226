#include "study/hard_cases/case_groups.h"
#include "study/hard_cases/case_report.h"

namespace hooke {
namespace {

constexpr std::string_view introduction = R"(# Stability: the hard cases

Scenes on which methods for mass-spring networks are known to fail, and the result of each method on them.
)";

constexpr std::string_view reading = R"(
## How to read it

A result is

* **held**: the criterion was met;
* *open*, failed openly: it was not, and the run reported it: by the divergence check, which stops the run, keeps the last good
  state, and names the point, the spring and a setting to try; by the status, which reports a step beyond the
  method's limit; by solves that did not converge; by an energy balance that does not close; or by the error estimate,
  for which every twentieth frame is repeated with half the step;
* -, out of scope: it does not apply to this method, for the reason given.

A silent failure ends `hooke check --hard` with exit code 1, and so does a failure where the method guarantees success.
A method whose step is beyond its own limit may fail openly. So may XPBD, which is stable for each spring
alone and guarantees nothing for many together, and the implicit midpoint rule, which damps nothing, where springs too fast for the
step rotate.

`auto` chooses the method and the substeps by a tolerance of 1e-5 m/s, while the criteria are absolute: it fails openly where the sum of the errors that it
estimates itself, those of all frames, is beyond the criterion, or where it reports that the tolerance was not met.

## Declared limits

* `baraff_witkin` solves one linear system per step. Its energy falls on every sheet here except the stiffest: crumpled at
  k dt^2 / m = 4e6, three of ten seeds gain up to 3e-10 of it in a step (1e-2 J of 4e7 J).
* Under a fast hand `baraff_witkin` rotates stiff springs by more than their length in a step and leaves them too long: with one step per frame
  briefly 15 times their length, with thousands of times the energy supplied by the hand. The next steps remove it. The divergence check tolerates this up to
  the energy that the hand's displacement in a step can store; the energy balance reports it.
* `xpbd` conserves momentum but not angular momentum: it corrects along the directions of the springs before the step. The loss decreases with
  the step, like its error; the same holds for every method that is not symplectic. A single sweep does not transmit a
  force through a long chain.
* `implicit_midpoint` damps nothing. Springs too fast for the step keep oscillating, and where they rotate, its energy drifts.
* A solve is limited to 20 factorizations in a run. One that needs more stops early, below the energy it started from, and is counted.
* First-order methods have first-order errors: with one step per frame, `implicit_euler` and `baraff_witkin` damp
  oscillations strongly, and the energy of `symplectic_euler` equals that of the scene only on average, less so
  near its limit.

## Which method for which hard case

* **Stiff springs at a step far beyond their stability limit** (1, 2, 7, 12, 16): `baraff_witkin` or `implicit_euler`, whose energy falls;
  `tr_bdf2` where the scene moves smoothly and the motion matters. Explicit methods take as many substeps as the limit
  requires and are then accurate; up to some thousand per frame that is cheaper (docs/accuracy.md).
* **Heavy ends and long chains** (3, 4): `velocity_verlet` at its limit, or any implicit method at a few substeps. Never
  `xpbd`: one sweep does not transmit a weight through a thousand links.
* **Strong dashpots** (11): `velocity_verlet` solves them exactly at any strength; `tr_bdf2` and `esdirk4` at one step per frame.
* **A fast mouse** (8): `velocity_verlet`, which is by far the cheapest there; of the implicit ones `tr_bdf2` from 4 substeps per frame
  on. With fewer steps these stay bounded, damp the motion, and report that their solves do not converge.
* **Contact of stiff cloth** (10, 19): `velocity_verlet`. Contacts are resolved after a step, for each point separately, so no method
  is better than its step: beyond 3 / omega the status warns, whatever the method.
* **Impacts and rest** (20, 21): any method; flights and impacts are solved within the step.
* **Chaotic motion** (17, 18): a closed energy balance is the strongest available check:
  `velocity_verlet`, `blanes_moan4`.
* **Resonance** (9): any method except the dissipative first-order ones.
)";

std::string_view outcome_label(const CaseResult* result) {
  if (result == nullptr || !result->finished) return "";
  if (is_broken(result->verdict)) return "**unexpected**";
  switch (result->verdict.outcome) {
    case Outcome::Held:
      return "held";
    case Outcome::FailedOpenly:
      return "*open*";
    case Outcome::FailedSilently:
      return "**silent**";
    case Outcome::OutOfScope:
      return "-";
  }
  return {};
}

std::string format_overview(std::span<const CaseResult> results) {
  const std::vector<const Integrator*> methods = methods_of(results);
  std::string head = "| case |", rule = "|---|";
  for (const Integrator* method : methods) {
    head += " " + std::string(method->id) + " |";
    rule += "---|";
  }
  std::string rows;
  for (const auto& group : by_case(results)) {
    rows += "| " + std::to_string(group[0].hard_case->number) + " " + std::string(group[0].hard_case->name) + " |";
    for (const Integrator* method : methods) rows += " " + std::string(outcome_label(find_result(group, *method))) + " |";
    rows += "\n";
  }
  return "\n## Overview\n\n" + head + "\n" + rule + "\n" + rows + "\n" + summarize_counts(results) + ".\n";
}

// The table of the case itself, one row per method and step.
std::string format_own_table(std::span<const CaseResult> group) {
  const std::string_view columns = group[0].hard_case->columns;
  if (columns.empty()) return {};
  std::string table = "\n| method | " + std::string(columns) + " |\n|---|";
  for (const char c : "|" + std::string(columns)) table += c == '|' ? "---|" : "";
  table += "\n";
  for (const CaseResult& result : group)
    for (const std::vector<std::string>& row : result.verdict.rows) {
      table += "| " + std::string(id_of(result)) + " |";
      for (const std::string& cell : row) table += " " + cell + " |";
      table += "\n";
    }
  return table;
}

std::string format_case(std::span<const CaseResult> group) {
  const HardCase& hard_case = *group[0].hard_case;
  std::string section = "\n## " + std::to_string(hard_case.number) + ". " + std::string(hard_case.name) + "\n\n";
  section += "Scene: " + std::string(hard_case.parameters) + ".\n\nCriterion: " + std::string(hard_case.criterion) + ".\n\n";
  if (!hard_case.remark.empty()) section += "Remark: " + std::string(hard_case.remark) + ".\n\n";
  section += "| method | result | measured | reported by, or reason |\n|---|---|---|---|\n";
  for (const CaseResult& result : group)
    if (result.finished)
      section += "| " + std::string(id_of(result)) + " | " + std::string(describe(result.verdict.outcome)) + " | " +
                 result.verdict.measured + " | " + result.verdict.reason + " |\n";
  return section + format_own_table(group);
}

}  // namespace

std::string format_markdown(std::span<const CaseResult> results, const Origin& origin) {
  std::string document(introduction);
  document += "Generated on " + origin.date + ", on one " + origin.machine + ", by\n\n    " + origin.command +
              "\n\nfrom the cases in `src/study/hard_cases` and the table of methods.\n";
  document += reading;
  document += format_overview(results);
  for (const auto& group : by_case(results)) document += format_case(group);
  return document;
}

}  // namespace hooke
