// A remedy in words.
#include "base/number_text.h"
#include "base/text_lines.h"
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

std::string duration_text(const TestedSetting& setting) {
  const std::string speed = speed_text(setting);
  return speed.empty() ? "" : "; about " + speed;
}

}  // namespace

std::string speed_text(const TestedSetting& setting) {
  return setting.duration > 1.0 ? number_text(1.0 / setting.duration, 2) + "\u00d7 real time" : "";
}

namespace {

// A clause for after a colon.
std::string cause_of(const Remedy& remedy, const Settings& settings) {
  using enum Remedy::Cause;
  switch (remedy.cause) {
    case StepTooLong:
      return "the step is beyond the linear stability limit of " + std::string(settings.integrator->label);
    case Force:
      return "the listed forces are the cause";
    case Contact:
      return "contact is the cause";
    case Hand:
      return "the hand is the cause";
    case Springs:
      return "springs rotate far within a step, which the linear stability limit does not cover";
    case NotReproduced:
    case SearchLimit:
    case NotFound:
      break;
  }
  return "the cause was not found";
}

// Where no other setting helps.
std::string change_for(Remedy::Cause cause) {
  using enum Remedy::Cause;
  if (cause == Force) return "Weaken the listed forces: ";
  if (cause == Contact) return "Move apart or slow down what touches: ";
  if (cause == Hand) return "Move the hand more slowly: ";
  return "Use softer springs, larger masses or slower motion: ";
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
  return change_for(remedy.cause) + cause_of(remedy, settings) + "; no remedy was found: " + tried + ".";
}

}  // namespace

std::string describe(const Remedy& remedy, const Settings& settings) {
  if (remedy.cause == Remedy::Cause::NotReproduced || remedy.cause == Remedy::Cause::SearchLimit) return untested(remedy);
  if (!remedy.cheapest) return without_remedy(remedy, settings);
  const TestedSetting& best = *remedy.cheapest;
  std::string text = (remedy.change ? "Undo " + remedy.change->text + ", without which it does not diverge, or use " : "Use ") +
                     describe(best.advice) + ", which does not diverge (tested for " + seconds_text(best.seconds) +
                     (remedy.from ? " from t = " + seconds_text(*remedy.from) : "") + duration_text(best) + ")" + exceptions(best.warnings);
  if (const auto& same = remedy.same_method)
    text += ", or " + describe(same->advice) + " (tested for " + seconds_text(same->seconds) + duration_text(*same) + ")" +
            exceptions(same->warnings);
  return text + (remedy.change ? "." : ": " + cause_of(remedy, settings) + ".");
}

}  // namespace hooke
