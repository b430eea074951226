# Writes OUT, a C++ file with the text of the files of the list NAMES in FOLDER.
# cmake -DOUT=... -DFOLDER=... -DNAMES=a.comp,b.glsl -P embed_compute.cmake
string(REPLACE "," ";" names "${NAMES}")
set(rows "")
foreach(name IN LISTS names)
  file(READ "${FOLDER}/${name}" text)
  string(APPEND rows "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
file(WRITE "${OUT}" "// Generated from shaders/compute/ by cmake/embed_compute.cmake.
#include \"device/gpu_scene.h\"

namespace hooke {

std::span<const ComputeSource> compute_sources() {
  static constexpr ComputeSource sources[] = {
${rows}  };
  return sources;
}

}  // namespace hooke
")
