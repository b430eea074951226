#include "formats/file_kinds.h"

namespace hooke {

constinit const FileKind json_file{
    .extension = ".json",
    .title = "Hooke scene",
    .is_native = true,
    .parse = parse_scene,
    .format = [](const Scene& scene, const std::string&, std::vector<std::string>&) { return format_scene(scene); }};

}  // namespace hooke
