# Precompiled headers: the standard and library headers that most sources include, compiled once for each set of compiler options.
# Sources still include everything they use: sanitizer builds and scripts/tidy compile without precompiled headers and fail on a missing
# include.

option(HOOKE_PRECOMPILED_HEADERS "Build faster: precompile common headers, join the sources of the command line" ON)

set(common_headers <algorithm> <array> <atomic> <chrono> <cmath> <filesystem> <functional> <glm/geometric.hpp> <memory> <optional> <span>
    <string> <string_view> <variant> <vector>)

# precompile(NAME HEADERS header... [LIBS target...] [OPTIONS option...] [PROPERTIES name value...]): a library NAME that contains only precompiled headers.
function(precompile name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "HEADERS;LIBS;OPTIONS;PROPERTIES")
  if(NOT HOOKE_PRECOMPILED_HEADERS)
    return()
  endif()
  file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT "")
  add_library(${name} STATIC ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE hooke_options glm::glm ${arg_LIBS})
  target_compile_options(${name} PRIVATE ${arg_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${arg_HEADERS})
  if(arg_PROPERTIES)
    set_target_properties(${name} PROPERTIES ${arg_PROPERTIES})
  endif()
endfunction()

# use_precompiled(NAME target...): compiles the targets with the headers of NAME, which must have the same compiler options.
function(use_precompiled name)
  if(NOT HOOKE_PRECOMPILED_HEADERS)
    return()
  endif()
  foreach(target IN LISTS ARGN)
    target_precompile_headers(${target} REUSE_FROM ${name})
  endforeach()
endfunction()

# Unity builds: several sources are compiled as one, so that what they have in common, such as the templates of the commands, is compiled
# once. That shortens a fresh build, but a change of one source compiles those joined with it again.
# join_sources(TARGET [BATCH count] SOURCES source... SEPARATE prefix...): joins the sources of the target, all of them or so many at a time,
# except those whose path begins with one of these prefixes: they define names in anonymous namespaces that others of the target define too.
function(join_sources target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "BATCH" "SOURCES;SEPARATE")
  if(NOT HOOKE_UNITY_BUILD)
    return()
  endif()
  if(NOT arg_BATCH)
    set(arg_BATCH 0)
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${arg_BATCH})
  foreach(prefix IN LISTS arg_SEPARATE)
    foreach(source IN LISTS arg_SOURCES)
      if(source MATCHES "^(sim/)?[a-z_]+/${prefix}")
        set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      endif()
    endforeach()
  endforeach()
endfunction()
