// A remedy in words.
#include <array>

#include "base/number_text.h"
#include "base/text_lines.h"
#include "sim/methods/integrator.h"
#include "study/remedy/remedy.h"

namespace hooke {
namespace {

std::string seconds_text(double seconds) { return quantity_text(seconds, "s", 3); }

// The warnings in quotation marks, since they have semicolons; empty without warnings.
std::string exceptions(const std::vector<std::string>& warnings) {
  if (warnings.empty()) return "";
  const std::string text = joined(warnings, [](const std::string& warning) { return "\"" + warning + "\""; });
  return (warnings.size() == 1 ? ", but there is a warning: " : ", but there are warnings: ") + text;
}

// By Remedy::Cause: a clause, and what to change where no other setting helps.
constexpr const char* any_change = "Use softer springs, larger masses or slower motion: ";
constexpr std::array<std::array<const char*, 2>, 8> causes{{
    {"", ""},
    {"", ""},
    {"the step is beyond the linear stability limit of ", any_change},
    {"the listed forces are the cause", "Weaken the listed forces: "},
    {"contact is the cause", "Move apart or slow down what touches: "},
    {"the hand is the cause", "Move the hand more slowly: "},
    {"springs rotate far within a step, which the linear stability limit does not cover", any_change},
    {"the cause was not found", any_change},
}};

std::string cause_of(const Remedy& remedy, const Settings& settings) {
  const bool is_step = remedy.cause == Remedy::Cause::StepTooLong;
  return causes[static_cast<std::size_t>(remedy.cause)][0] + std::string(is_step ? settings.integrator->label : "");
}

std::string untested(const Remedy& remedy) {
  const std::string from = remedy.from ? "t = " + seconds_text(*remedy.from) : "the start";
  if (remedy.cause == Remedy::Cause::NotReproduced)
    return "Run on from an earlier state: copies from the start" + (remedy.from ? " and from " + from : "") +
           " do not diverge, and no remedy was tested.";
  return "Use more substeps or an implicit method: no remedy was tested, because the work limit of the search was reached at t = " +
         seconds_text(remedy.reached) + ", before the copy from " + from + " diverged.";
}

std::string without_remedy(const Remedy& remedy, const Settings& settings) {
  std::string tried = std::to_string(remedy.settings_tried) + " other settings were tried without success";
  if (remedy.settings_cut_short > 0)
    tried += ", " + std::to_string(remedy.settings_cut_short) + " of them only up to the work limit of the search";
  if (remedy.settings_left > 0) tried += "; " + std::to_string(remedy.settings_left) + " more were not, because of that limit";
  if (remedy.change) return "Undo " + remedy.change->text + ", without which it does not diverge: " + tried + ".";
  return causes[static_cast<std::size_t>(remedy.cause)][1] + cause_of(remedy, settings) + "; no remedy was found: " + tried + ".";
}

}  // namespace

std::string speed_text(const TestedSetting& setting, const char* before, const char* after) {
  return setting.duration > 1.0 ? before + number_text(1.0 / setting.duration, 2) + "\u00d7 real time" + after : "";
}

std::string describe(const Remedy& remedy, const Settings& settings) {
  if (remedy.cause == Remedy::Cause::NotReproduced || remedy.cause == Remedy::Cause::SearchLimit) return untested(remedy);
  if (!remedy.cheapest) return without_remedy(remedy, settings);
  const TestedSetting& best = *remedy.cheapest;
  std::string text = (remedy.change ? "Undo " + remedy.change->text + ", without which it does not diverge, or use " : "Use ") +
                     describe(best.advice) + ", which does not diverge (tested for " + seconds_text(best.seconds) +
                     (remedy.from ? " from t = " + seconds_text(*remedy.from) : "") + speed_text(best, "; about ") + ")" +
                     exceptions(best.warnings);
  if (const auto& same = remedy.same_method)
    text += ", or " + describe(same->advice) + " (tested for " + seconds_text(same->seconds) + speed_text(*same, "; about ") + ")" +
            exceptions(same->warnings);
  else if (const auto& slow = remedy.untested)
    text += " (" + describe(slow->advice) + ", at " + speed_text(*slow) + ", takes too long to be tested)";
  return text + (remedy.change ? "." : ": " + cause_of(remedy, settings) + ".");
}

}  // namespace hooke
