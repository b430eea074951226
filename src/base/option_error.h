// Values that an option or a parameter may not have.
#pragma once

#include <string>
#include <string_view>

#include "base/bounds.h"
#include "base/errors.h"

namespace hooke {

// "--frame-rate 0: must be more than 0". The interfaces for C++ and Python name the argument instead: "frame_rate: 0: must be more than 0".
class OptionError : public UsageError {
 public:
  // `option`: without the dashes in front; `text`: the value and the reason.
  OptionError(const std::string& option, const std::string& text);
  OptionError(const std::string& option, const std::string& value, const std::string& reason);
  const std::string& as_argument() const { return as_argument_; }
  const std::string& reason() const { return reason_; }

 private:
  std::string reason_, as_argument_;
};

// Why a value is not allowed: "must be at least 0", "must be a finite number"; empty if it is allowed.
std::string why_refused(double value, const Bounds& bounds);

// Throws InputError "FIELD: VALUE: must be ..." for the same, for a value that is not from an option.
void check_value(const std::string& field, double value, const Bounds& bounds);

// Throws OptionError for a number that is not finite or not within the bounds.
void check_option(const std::string& option, double value, const Bounds& bounds);

// "did you mean cloth or cloth_32?": the choices that a name resembles, the nearest first; empty if there are none.
std::string did_you_mean(const std::string& choices, std::string_view name, std::size_t max_names);

// "must be one of cloth, rope, flag; did you mean rope?", for a name that is none of the choices "cloth, rope, flag".
std::string must_be_one_of(const std::string& choices, std::string_view name);

}  // namespace hooke
