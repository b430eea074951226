// A camera as a line of text, to be copied from the window and given to `hooke capture --camera`.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "draw/camera.h"

namespace hooke {

// "x,y,z,x,y,z": the eye and its target [m], and ",orthographic" where it is. Reads back as the same numbers.
std::string camera_text(const CameraPose& pose);

// None when it is not such a text, or the eye is at its target.
std::optional<CameraPose> camera_from_text(std::string_view text);

}  // namespace hooke
