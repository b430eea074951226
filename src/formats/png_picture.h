// Pictures from untrusted PNG files.
#pragma once

#include <string>
#include <string_view>

#include "scene/view_settings.h"

namespace hooke {

// The picture in 8 bits per channel, transparent parts blended with white, and halved until it is not larger than drawing needs. Its size
// is checked before decoding. Throws InputError; `name` is that of the file in messages.
Picture decode_png(std::string_view file, const std::string& name);

}  // namespace hooke
