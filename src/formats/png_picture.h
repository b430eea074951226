// Pictures from PNG files of unknown origin.
#pragma once

#include <string>
#include <string_view>

#include "scene/view_settings.h"

namespace hooke {

// The picture in 8 bits a channel, on white where it can be seen through, and halved until neither side is beyond what
// drawing needs. Its size is checked before anything is decoded. Throws InputError; `name` stands for the file in messages.
Picture decode_png(std::string_view bytes, const std::string& name);

}  // namespace hooke
