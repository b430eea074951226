# The source archive is named by its version, is reproducible, and contains every file of the commit:
# cmake -DSOURCES=FOLDER -DVERSION=VERSION -P source_archive_test.cmake
cmake_minimum_required(VERSION 3.25)

string(RANDOM LENGTH 12 name)
set(place /tmp/hooke-archive-${name})

function(fail message)
  file(REMOVE_RECURSE ${place})
  message(FATAL_ERROR "${message}")
endfunction()

foreach(turn first second)
  execute_process(COMMAND ${SOURCES}/scripts/source-archive HEAD ${place}/${turn} OUTPUT_VARIABLE path_${turn} OUTPUT_STRIP_TRAILING_WHITESPACE
                  RESULT_VARIABLE code ERROR_VARIABLE error)
  if(code)
    fail("scripts/source-archive: ${code}: ${error}")
  endif()
  file(SHA256 ${path_${turn}} hash_${turn})
endforeach()
if(NOT hash_first STREQUAL hash_second)
  fail("two archives of the same commit differ")
endif()

file(ARCHIVE_EXTRACT INPUT ${path_first} DESTINATION ${place})
if(NOT path_first STREQUAL "${place}/first/hooke-${VERSION}.tar.gz" OR NOT EXISTS ${place}/hooke-${VERSION}/CMakeLists.txt)
  fail("not hooke-${VERSION}: ${path_first}")
endif()
execute_process(COMMAND git ls-tree -r --name-only HEAD WORKING_DIRECTORY ${SOURCES} OUTPUT_VARIABLE tracked)
string(REPLACE "\n" ";" tracked "${tracked}")
foreach(file IN LISTS tracked)
  if(NOT EXISTS "${place}/hooke-${VERSION}/${file}")
    fail("the archive lacks ${file}")
  endif()
endforeach()
file(REMOVE_RECURSE ${place})
