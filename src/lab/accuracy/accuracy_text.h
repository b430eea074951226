// The accuracy of a run in words: for panels, reports and pictures.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/model/accuracy.h"
#include "sim/model/settings.h"

namespace hooke {

// A reason why the cost of half the error is not known.
inline constexpr std::string_view half_step_does_not_help = "half the step does not halve the error here";

// Two digits with a unit for the size: "21 um", "0.34 mm", "1.2 m"; "< 1 pm" for what is less.
std::string length_text(double length);

// "21 um (0.002 % of the size)", or the reason why it is not known.
std::string error_text(const Measured& error, double size);
// "predictable", "predictable for about 3 s more", "chaotic: only averages are meaningful", or the reason why it is not known.
std::string predictability_text(const Accuracy& accuracy);

// One line: "error 21 um/frame, 0.3 mm in total, predictable"
std::string accuracy_line(const Accuracy& accuracy);
// The same, followed by shorter lines for less space: without the predictability, and without the total.
std::vector<std::string> accuracy_lines(const Accuracy& accuracy);

// A warning in one clause: the accumulated error is large in comparison with the motion, or is not known because the run lost the motion;
// and why no setting helps, if so. None where it is small, or not measured.
std::optional<std::string> accumulated_warning(const Accuracy& accuracy);
// [m/s], of one digit, within the range of the slider: with it the error that is warned about may be a hundredth of the motion. None
// without a warning, and where no tolerance helps.
std::optional<double> tolerance_to_try(const Accuracy& accuracy, const Settings& settings);

}  // namespace hooke
