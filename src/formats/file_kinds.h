// Declarations of the file formats of list.inc.
#pragma once

#include "formats/file_kind.h"

namespace hooke {

#define ROW(name) extern const FileKind name##_file;
#include "formats/list.inc"
#undef ROW

}  // namespace hooke
