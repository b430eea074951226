# Checks who includes whom: cmake -DSOURCES=DIRECTORY -P layers.cmake
# SOURCES holds a folder a layer. Fails, with a line for every violation, when
#  - a file includes a layer that its own may not use,
#  - a file includes a third-party or system header that another file owns, or that nobody owns yet,
#  - physics includes a clock, random numbers, files or an unordered container,
#  - a file outside sim and lab can write a System or a State.
cmake_minimum_required(VERSION 3.25)

# The modules and whom each may include: the table that the build is made from.
include(${CMAKE_CURRENT_LIST_DIR}/../src/modules.cmake)
set(layers ${hooke_modules})
foreach(layer IN LISTS layers)
  set(may_use_${layer} ${layer} ${${layer}_uses})
endforeach()

# Owners of headers: a header's name, and the files that may include it. The first name that fits decides.
set(owners
  "^GL/osmesa[.]h$"                     "^cli/offscreen[.]cpp$"
  "^GL/"                                "^draw/"
  "^GLFW/"                              "^app/window/"
  "^(imgui|imstb|misc/|backends/).*"    "^(ui/|draw/gl/gui_renderer[.]|app/window/imgui_backend[.])"
  "^png[.]h$"                           "^(draw/|formats/png_picture[.]cpp$)"
  "^rapidjson/"                         "^(base/|study/work_precision_file[.]cpp$)"
  "^tiny_obj_loader[.]h$"               "^formats/obj_text[.]cpp$"
  "^CLI/"                               "^(cli/|app/window/main[.]cpp$)"
  "^hwy/"                               "^sim/"
  "^Eigen/"                             "^sim/"
  "^glm/"                               "."
  "^malloc[.]h$"                        "^draw/gl/gl[.]cpp$"
  "^(chrono|ctime|random|thread|iostream|fstream|filesystem|unordered_map|unordered_set)$"  "^(base|formats|lab|study|draw|ui|app|cli)/"
  "^cstdio$"                            "^(base|scene|formats|lab|study|draw|ui|app|cli)/"
  "^(unistd|fcntl|dirent|signal|spawn|sys/[a-z]+)[.]h$"  "^(base|formats|lab|study|app|cli)/"
  "^[a-z_]+$"                           "."  # the C++ standard library
)

set(violations 0)
macro(refuse file reason)
  message(STATUS "${file}: ${reason}")
  math(EXPR violations "${violations} + 1")
endmacro()

function(check_layer file layer header)
  string(REGEX MATCH "^[^/]+" used "${header}")
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
    string(REGEX MATCH "^[^/]+/" first "${header}")
    string(REPLACE "/" "" first "${first}")
    if(first IN_LIST layers)
      check_layer("${file}" ${layer} "${header}")
    elseif(include MATCHES "<")
      check_owner("${file}" "${header}")
    else()
      refuse("${file}" "includes \"${header}\": our own headers are named by layer, as \"sim/plan.h\"")
    endif()
  endforeach()
  set(violations ${violations} PARENT_SCOPE)
endfunction()

# System and State are read-only outside sim and lab: no reference, pointer or pointer type to one that is not const.
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

file(GLOB_RECURSE files RELATIVE "${SOURCES}" "${SOURCES}/*.h" "${SOURCES}/*.cpp")
if(NOT files)
  message(FATAL_ERROR "no sources in '${SOURCES}'")
endif()
foreach(file IN LISTS files)
  string(REGEX MATCH "^[^/]+" layer "${file}")
  if(NOT layer IN_LIST layers)
    refuse("${file}" "stands in no layer")
    continue()
  endif()
  # brackets and semicolons mean something to CMake's lists, and nothing here
  file(READ "${SOURCES}/${file}" text)
  string(REGEX REPLACE "[][;]" " " text "${text}")
  check_includes("${file}" ${layer} "${text}")
  if(NOT layer MATCHES "^(sim|scene|formats|edit|lab|study)$")
    check_constness("${file}" "${text}")
  endif()
endforeach()

list(LENGTH files count)
if(violations)
  message(FATAL_ERROR "${violations} violations in ${count} files")
endif()
message(STATUS "${count} files keep to their layers")
