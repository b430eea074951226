# Checks the structure of the sources: cmake -DSOURCES=DIRECTORY [-DTESTS=DIRECTORY] -P layers.cmake
# SOURCES holds a folder for each module (src/modules.cmake). In TESTS, only the length of files is checked. Fails, with a line for each violation, when
#  - a file includes a module that its own module may not use,
#  - a file includes a third-party or system header that belongs to another file, or that has no owner yet,
#  - physics includes a clock, random numbers, files or an unordered container,
#  - a file outside sim, scene, formats, edit, lab and study can write a System or a State,
#  - a file has more than 400 lines, or a folder more than 40 files.
cmake_minimum_required(VERSION 3.25)

set(max_lines 400)
set(max_files 40)

# The modules and the modules that each may include: the table that the build uses.
include(${CMAKE_CURRENT_LIST_DIR}/../src/modules.cmake)
set(layers ${hooke_modules})
list(JOIN physics_modules "|" physics)

# The module of a file or header, by its path in SOURCES; empty: none.
function(module_of path result)
  if("${path}" MATCHES "^sim/(${physics})/")
    set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
  elseif("${path}" MATCHES "^([^/]+)/" AND CMAKE_MATCH_1 IN_LIST layers AND NOT CMAKE_MATCH_1 IN_LIST physics_modules)
    set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
  else()
    set(${result} "" PARENT_SCOPE)
  endif()
endfunction()

foreach(layer IN LISTS layers)
  set(may_use_${layer} ${layer} ${${layer}_uses})
endforeach()

# Owners of headers: a pattern of header names, and the files that may include them. The first match decides.
set(owners
  "^GL/osmesa[.]h$"                     "^batch/offscreen[.]cpp$"
  "^GL/"                                "^(draw|device)/"
  "^GLFW/"                              "^app/window/"
  "^(imgui|imstb|misc/|backends/).*"    "^(ui/|draw/gl/gui_renderer[.]|app/window/imgui_backend[.])"
  "^png[.]h$"                           "^(draw/|formats/png_picture[.]cpp$)"
  "^pugixml[.]hpp$"                     "^formats/"
  "^rapidjson/"                         "^(base/|study/work_precision_file[.]cpp$)"
  "^(webp/|gif_lib)"                    "^draw/film/"
  "^zlib[.]h$"                          "^base/read_file[.]cpp$"
  "^CLI/"                               "^(cli/|app/window/main[.]cpp$)"
  "^pybind11/"                          "^python/"
  "^hwy/"                               "^sim/"
  "^(unsupported/)?Eigen/"              "^(sim/|study/spectrum[.]cpp$)"
  "^glm/"                               "."
  "^malloc[.]h$"                        "^(draw/gl/gl|cli/main)[.]cpp$"
  "^(chrono|ctime|random|thread|iostream|fstream|filesystem|unordered_map|unordered_set)$"  "^(base|formats|lab|study|draw|ui|app|batch|cli|python)/"
  "^cstdio$"                            "^(base|scene|formats|lab|study|draw|ui|app|batch|cli|python)/"
  "^(unistd|fcntl|dirent|poll|signal|spawn|dlfcn|link|sys/[a-z]+)[.]h$"  "^(base|device|formats|lab|study|draw/film|app|batch|cli)/"
  "^stdint[.]h$"                        "^api/hooke_c[.]h$"  # for C
  "^[a-z_]+$"                           "."  # the C++ standard library
)

set(violations 0)
macro(refuse file reason)
  message(STATUS "${file}: ${reason}")
  math(EXPR violations "${violations} + 1")
endmacro()

function(check_layer file layer header)
  module_of("${header}" used)
  if(NOT used IN_LIST may_use_${layer})
    refuse("${file}" "includes ${header}, but ${layer} may use only: ${may_use_${layer}}")
  endif()
  set(violations ${violations} PARENT_SCOPE)
endfunction()

function(check_owner file header)
  set(rest ${owners})
  while(rest)
    list(POP_FRONT rest name owner)
    if(header MATCHES "${name}")
      if(NOT file MATCHES "${owner}")
        refuse("${file}" "includes <${header}>, which belongs to ${owner}")
      endif()
      set(violations ${violations} PARENT_SCOPE)
      return()
    endif()
  endwhile()
  refuse("${file}" "includes <${header}>, which has no owner in layers.cmake")
  set(violations ${violations} PARENT_SCOPE)
endfunction()

function(check_includes file layer text)
  string(REGEX MATCHALL "#[ \t]*include[ \t]*[\"<][^\">\n]*[\">]" includes "${text}")
  foreach(include IN LISTS includes)
    string(REGEX REPLACE "^[^\"<]*[\"<](.*)[\">]$" "\\1" header "${include}")
    module_of("${header}" used)
    if(used)
      check_layer("${file}" ${layer} "${header}")
    elseif(include MATCHES "<")
      check_owner("${file}" "${header}")
    else()
      refuse("${file}" "includes \"${header}\": headers of Hooke are included by module, as in \"sim/plan/plan.h\"")
    endif()
  endforeach()
  set(violations ${violations} PARENT_SCOPE)
endfunction()

# Outside the modules that may write a System or a State, no reference, pointer or smart pointer to one may be non-const.
function(check_constness file text)
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  set(type "(hooke::)?[A-Za-z0-9_]*(System|State)")
  string(REGEX MATCHALL "(const[ \t\n]+|<[ \t\n]*)?${type}[ \t\n]*[&*>]" uses "${text}")
  foreach(use IN LISTS uses)
    if(use MATCHES "^(hooke::)?(System|State)[ \t\n]*[&*]$" OR use MATCHES "^<[ \t\n]*(hooke::)?(System|State)[ \t\n]*>$")
      refuse("${file}" "can write a System or State: ${use}")
    endif()
  endforeach()
  set(violations ${violations} PARENT_SCOPE)
endfunction()

function(check_lines file text)
  string(REGEX MATCHALL "\n" ends "${text}")
  list(LENGTH ends lines)
  if(lines GREATER max_lines)
    refuse("${file}" "has ${lines} lines, more than ${max_lines}")
  endif()
  set(violations ${violations} PARENT_SCOPE)
endfunction()

# The number of files in each folder, subfolders not counted.
function(check_folders)
  foreach(file IN LISTS ARGN)
    get_filename_component(folder "${file}" DIRECTORY)
    list(APPEND folders "${folder}")
    math(EXPR count_${folder} "0${count_${folder}} + 1")
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder IN LISTS folders)
    if(count_${folder} GREATER max_files)
      refuse("${folder}" "has ${count_${folder}} files, more than ${max_files}")
    endif()
  endforeach()
  set(violations ${violations} PARENT_SCOPE)
endfunction()

file(GLOB_RECURSE files RELATIVE "${SOURCES}" "${SOURCES}/*.h" "${SOURCES}/*.cpp")
if(NOT files)
  message(FATAL_ERROR "no sources in '${SOURCES}'")
endif()
foreach(file IN LISTS files)
  module_of("${file}" layer)
  if(NOT layer)
    refuse("${file}" "is in no module")
    continue()
  endif()
  # Brackets and semicolons are special in CMake lists, and not needed here.
  file(READ "${SOURCES}/${file}" text)
  string(REGEX REPLACE "[][;]" " " text "${text}")
  check_includes("${file}" ${layer} "${text}")
  if(NOT layer MATCHES "^(${physics}|scene|formats|edit|lab|study)$")
    check_constness("${file}" "${text}")
  endif()
  check_lines("${file}" "${text}")
endforeach()
check_folders(${files})

if(TESTS)
  file(GLOB_RECURSE tests RELATIVE "${TESTS}" "${TESTS}/*.h" "${TESTS}/*.cpp")
  foreach(file IN LISTS tests)
    file(READ "${TESTS}/${file}" text)
    string(REGEX REPLACE "[][;]" " " text "${text}")
    check_lines("tests/${file}" "${text}")
  endforeach()
  list(APPEND files ${tests})
endif()

list(LENGTH files count)
if(violations)
  message(FATAL_ERROR "${violations} violations in ${count} files")
endif()
message(STATUS "${count} files conform to the structure")
