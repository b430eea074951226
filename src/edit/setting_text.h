// Settings as text, NAME=VALUE, and methods by their ids: on the command line and in the interfaces for C++ and Python.
#pragma once

#include <string>

#include "base/option_error.h"
#include "edit/command.h"

namespace hooke {

// Throws OptionError if there is no such method.
const Integrator& parse_integrator(const std::string& id);

// Throws OptionError if there is no such parameter.
const Parameter& parse_parameter(const std::string& name);

// A value out of range is an error here, not clamped. Throws OptionError.
SetParameter parse_setting(const std::string& name, const std::string& value);
SetParameter parse_setting(const std::string& setting);  // NAME=VALUE

// Applies a setting to a scene that was loaded from `name`. Throws InputError if the scene cannot become 2-D.
void apply_setting(Scene& scene, const SetParameter& setting, const std::string& name);

}  // namespace hooke
