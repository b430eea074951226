// Settings as text, NAME=VALUE, and methods by their ids: on the command line and in the interfaces for C++ and Python.
#pragma once

#include <string>

#include "base/bounds.h"
#include "base/errors.h"
#include "edit/command.h"

namespace hooke {

// "explicit_euler, ..." of all methods; the names of all parameters.
std::string ids_of_integrators();
std::string names_of_parameters();

// Throws UsageError if there is no such method.
const Integrator& parse_integrator(const std::string& id);

// NAME=VALUE. A value out of range is an error here, not clamped. Throws UsageError.
SetParameter parse_setting(const std::string& setting);

// Applies a setting to a scene that was loaded from `name`. Throws InputError if the scene cannot become 2-D.
void apply_setting(Scene& scene, const SetParameter& setting, const std::string& name);

// Throws UsageError "--option: VALUE: must be ..." for a number that is not finite or not within the bounds.
void check_option(const std::string& option, double value, const Bounds& bounds);

}  // namespace hooke
