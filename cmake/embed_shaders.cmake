# Writes OUT, a C++ file with the text of NAME.vert and NAME.frag in FOLDER for each NAME of the list NAMES.
# cmake -DOUT=... -DFOLDER=... -DNAMES=a,b -P embed_shaders.cmake
string(REPLACE "," ";" names "${NAMES}")
set(rows "")
foreach(name IN LISTS names)
  file(READ "${FOLDER}/${name}.vert" vertex)
  file(READ "${FOLDER}/${name}.frag" fragment)
  string(APPEND rows "    {\"${name}\",\n     R\"glsl(${vertex})glsl\",\n     R\"glsl(${fragment})glsl\"},\n")
endforeach()
file(WRITE "${OUT}" "// Generated from shaders/ by cmake/embed_shaders.cmake.
#include \"draw/gl/shader.h\"

namespace hooke {

std::span<const ShaderSource> shader_sources() {
  static constexpr ShaderSource sources[] = {
${rows}  };
  return sources;
}

}  // namespace hooke
")
