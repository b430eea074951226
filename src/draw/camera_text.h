// A camera as one line of text, to copy from the window into `hooke capture --camera`.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "draw/camera.h"

namespace hooke {

// "x,y,z,x,y,z": the eye and its target [m], followed by ",orthographic" for an orthographic camera. Round-trips exactly.
std::string camera_text(const CameraPose& pose);

// Nothing if the text is not in this form or the eye is at the target.
std::optional<CameraPose> camera_from_text(std::string_view text);

}  // namespace hooke
