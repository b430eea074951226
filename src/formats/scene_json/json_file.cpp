#include "formats/file_kinds.h"

namespace hooke {

constinit const FileKind json_file{
    .extension = ".json",
    .title = "Hooke scene",
    .is_native = true,
    .parse = [](std::string_view text, const std::string& file, const ImportOptions&) { return parse_scene(text, file); },
    .format = [](const Scene& scene, const std::string&, std::vector<std::string>&) { return format_scene(scene); }};

}  // namespace hooke
