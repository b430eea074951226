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

std::string describe(const Remedy& remedy, const Settings& settings) {
  const auto cause = [&]() -> std::string {
    if (remedy.change) return "Cause: " + remedy.change->text + "; without this change it does not diverge.";
    switch (remedy.cause) {
      case Remedy::Cause::NotReproduced:
        return "No remedy was tested: copies from the start" + (remedy.from ? " and from t = " + seconds_text(*remedy.from) : "") +
               " do not diverge.";
      case Remedy::Cause::SearchLimit:
        return "No remedy was tested: the work limit of the search was reached at t = " + seconds_text(remedy.reached) +
               ", before the copy from " + (remedy.from ? "t = " + seconds_text(*remedy.from) : "the start") + " diverged.";
      case Remedy::Cause::StepTooLong:
        return "Cause: the step is beyond the linear stability limit of " + std::string(settings.integrator->label) + ".";
      case Remedy::Cause::Force:
        return "Cause: the listed forces; without them it does not diverge.";
      case Remedy::Cause::Contact:
        return "Cause: contact; without it the scene does not diverge.";
      case Remedy::Cause::Hand:
        return "Cause: the hand; without it the scene does not diverge.";
      case Remedy::Cause::Springs:
        return "Cause: springs that rotate far within a step; the linear stability limit does not cover them.";
      case Remedy::Cause::NotFound:
        return "The cause was not found.";
    }
    return {};
  };
  if (remedy.cause == Remedy::Cause::NotReproduced || remedy.cause == Remedy::Cause::SearchLimit) return cause();
  if (!remedy.cheapest) {
    const std::string tried = " other settings were tried" + std::string(remedy.change ? " without success" : "");
    std::string cut_short;
    if (remedy.settings_cut_short > 0)
      cut_short = ", " + std::to_string(remedy.settings_cut_short) + " of them only up to the work limit of the search";
    if (remedy.settings_left > 0) cut_short += "; " + std::to_string(remedy.settings_left) + " more were not, because of that limit";
    return cause() + (remedy.change ? " " : " No remedy found: ") + std::to_string(remedy.settings_tried) + tried + cut_short + ".";
  }
  const std::string from = remedy.from ? " from t = " + seconds_text(*remedy.from) : "";
  const TestedSetting& best = *remedy.cheapest;
  std::string text = cause() + " " + describe(best.advice) + " does not diverge (tested for " + seconds_text(best.seconds) + from +
                     duration_text(best) + ")" + exceptions(best.warnings) + ".";
  if (const auto& same = remedy.same_method)
    text += " Nor does " + describe(same->advice) + " (tested for " + seconds_text(same->seconds) + duration_text(*same) + ")" +
            exceptions(same->warnings) + ".";
  else if (const auto& untested = remedy.untested)
    text += " " + describe(untested->advice) + " takes too long to be tested" + duration_text(*untested) + ".";
  return text;
}

}  // namespace hooke
