# Writes OUT, a C++ file that holds the text of every NAME.vert and NAME.frag of FOLDER, NAMES being a list.
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
