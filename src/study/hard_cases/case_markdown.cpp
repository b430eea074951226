#include "study/hard_cases/case_groups.h"
#include "study/hard_cases/case_report.h"

namespace hooke {
namespace {

constexpr std::string_view introduction = R"(# Stability: the hard cases

Scenes on which methods for springs are known to fail, and what became of each method in them.
)";

constexpr std::string_view reading = R"(
## How to read it

A result is

* **held**: the criterion was met;
* *open*, failed openly: it was not, and the run said so. By the watch for divergence, which stops it, keeps the last good
  state, and names the point, the spring, and what would hold; by the status, which says that the step is beyond the
  method's limit; by solves that did not converge; by an energy balance that does not close; or by its own estimate of
  the error, for which every twentieth frame is done again with half the step;
* -, out of scope: not a question to this method, for the reason given.

No method may fail in silence: `hooke check --hard` then ends with exit code 1, and so it does when a method fails at what it
promises. A method that steps beyond its own limit may fail, if it says so, and so may XPBD, which holds for each spring
alone and promises nothing of many together, and the midpoint rule where springs too fast for the step turn, since it
damps nothing.

## Limits, declared

* `baraff_witkin` solves one linear system a step. Its energy falls on every sheet here but the stiffest: crumpled at
  k dt^2 / m = 4e6, three of ten seeds gain up to 3e-10 of it in a step (1e-2 J of 4e7 J).
* Under a fast hand `baraff_witkin` turns stiff springs by more than their length in a step, and leaves them that much too long: at a step a frame 15 times
  their length for a moment, holding thousands of times what the hand gave. The next steps take it back. The watch lets it be, up to
  what the hand's way in a step could stretch; the energy balance says it.
* `xpbd` keeps momentum and not angular momentum: it corrects along springs as they lay before the step. What it loses falls with
  the step, as its error does; the same is true of every method that is not symplectic. Nor does one of its sweeps carry a
  force through a long chain.
* `implicit_midpoint` damps nothing. Springs too fast for the step keep ringing, and where they turn, its energy drifts.
* A solve may take 20 factorisations in a run. One that needs more is cut short below where it began, and is counted.
* Methods of first order are as far off as first order is: at a step a frame, `implicit_euler` and `baraff_witkin` take
  the swing out of what swings, and the energy of `symplectic_euler` is that of the scene only on the average, the less so the
  nearer its limit.

## Which method for which hard case

* **Stiff springs at a step far beyond theirs** (1, 2, 7, 12, 16): `baraff_witkin` or `implicit_euler`, whose energy falls;
  `tr_bdf2` where the scene moves smoothly and the motion matters. Explicit methods take as many substeps as the limit
  asks for, and are then exact; up to some thousand a frame that is the cheaper way (docs/accuracy.md).
* **Heavy ends and long chains** (3, 4): `velocity_verlet` at its limit, or any implicit method at a few substeps. Never
  `xpbd`: one sweep does not carry a weight through a thousand links.
* **Strong dashpots** (11): `velocity_verlet` takes them exactly at any size; `tr_bdf2` and `esdirk4` at one step a frame.
* **A fast mouse** (8): `velocity_verlet`, which is by far the cheapest there; of the implicit ones `tr_bdf2` from 4 substeps a frame
  on. At fewer steps than they hold at, these stay bounded, take the motion out, and say that their solves do not converge.
* **Contact of stiff cloth** (10, 19): `velocity_verlet`. Contacts act after a step, on each point alone, so that no method
  is better at them than its step: beyond 3 / omega the status says so, whatever the method.
* **Impacts and rest** (20, 21): any method; flights and impacts are solved within the step.
* **Motion that cannot be predicted** (17, 18): a budget of energy that closes is all that can be had:
  `velocity_verlet`, `blanes_moan4`.
* **Resonance** (9): any method but those of first order that damp.
)";

std::string_view outcome_label(const CaseResult* result) {
  if (result == nullptr || !result->finished) return "";
  if (is_broken(result->verdict)) return "**against expectation**";
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
  return "\n## All at once\n\n" + head + "\n" + rule + "\n" + rows + "\n" + summarize_counts(results) + ".\n";
}

// The case's own, a row a method and step.
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
  section += "| method | result | measured | reported by, or why not |\n|---|---|---|---|\n";
  for (const CaseResult& result : group)
    if (result.finished)
      section += "| " + std::string(id_of(result)) + " | " + std::string(describe(result.verdict.outcome)) + " | " +
                 result.verdict.measured + " | " + result.verdict.reason + " |\n";
  return section + format_own_table(group);
}

}  // namespace

std::string format_markdown(std::span<const CaseResult> results, const Origin& origin) {
  std::string document(introduction);
  document += "Made on " + origin.date + ", on one " + origin.machine + ", by\n\n    " + origin.command +
              "\n\nfrom the table in `src/study/hard_cases/hard_cases.cpp`, where " + "the cases stand, and the table of methods.\n";
  document += reading;
  document += format_overview(results);
  for (const auto& group : by_case(results)) document += format_case(group);
  return document;
}

}  // namespace hooke
