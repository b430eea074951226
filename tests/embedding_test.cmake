# Installs the library, moves the installation, and builds programs with it: cmake -DBUILD=FOLDER -DEXAMPLE=FOLDER -DDOCS=FILE -DLIBDIR=PATH
# -P embedding_test.cmake. The example is built by find_package, the program of docs/embedding.md by pkg-config.
cmake_minimum_required(VERSION 3.25)

string(RANDOM LENGTH 12 name)
set(place /tmp/hooke-embedding-${name})
set(moved ${place}/moved)

# Runs a command; if it fails, the test ends with its output.
function(need what)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${place} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT code EQUAL 0)
    file(REMOVE_RECURSE ${place})
    message(FATAL_ERROR "${what}: ${code}\n${output}${errors}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(MAKE_DIRECTORY ${place})
foreach(component hooke library development)
  need("install ${component}" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${place}/first --component ${component})
endforeach()
file(RENAME ${place}/first ${moved})

need("configure" ${CMAKE_COMMAND} -S ${EXAMPLE} -B ${place}/example -DCMAKE_PREFIX_PATH=${moved})
need("build" ${CMAKE_COMMAND} --build ${place}/example)
need("run" ${place}/example/embed)
if(NOT output MATCHES "1.00 s: sag 0[.]14[0-9]+ m, energy [-0-9.]+ J, error [0-9.e-]+ m\nlibhooke [0-9.]+, hash [0-9a-f]+\n$")
  message(FATAL_ERROR "the example prints: ${output}")
endif()

# the first code block of the page
file(READ ${DOCS} page)
string(REGEX MATCH "```cpp\n([^`]*)```" block "${page}")
file(WRITE ${place}/program.cpp "${CMAKE_MATCH_1}")
set(ENV{PKG_CONFIG_PATH} ${moved}/${LIBDIR}/pkgconfig)
need("pkg-config" sh -c "c++ -std=c++20 -Wall -Werror program.cpp $(pkg-config --cflags --libs hooke) -o program")
set(ENV{LD_LIBRARY_PATH} ${moved}/${LIBDIR})
need("run" ${place}/program)
if(NOT output MATCHES "^point 0 at [-0-9.e]+ [-0-9.e]+ [-0-9.e]+ m\n$")
  message(FATAL_ERROR "the program of the page prints: ${output}")
endif()

# nothing but the interface is exported
need("nm" nm -DC --defined-only --format=just-symbols ${moved}/${LIBDIR}/libhooke.so)
string(REGEX MATCHALL "[^\n]+" symbols "${output}")
list(LENGTH symbols count)
list(FILTER symbols EXCLUDE REGEX "^(hooke::v1::|HOOKE_1|(typeinfo( name)?|vtable) for hooke::v1::Error)")
if(symbols OR count LESS 20)
  message(FATAL_ERROR "${count} symbols are exported, among them: ${symbols}")
endif()
file(REMOVE_RECURSE ${place})
