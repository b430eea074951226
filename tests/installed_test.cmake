# Installs Hooke, moves the installation, and runs it there: cmake -DBUILD=FOLDER -P installed_test.cmake
# The program must use the scenes of the moved installation.
cmake_minimum_required(VERSION 3.25)

string(RANDOM LENGTH 12 name)
set(first /tmp/hooke-installed-${name})
set(moved /tmp/hooke-moved-${name})

function(fail message)
  file(REMOVE_RECURSE ${first} ${moved})
  message(FATAL_ERROR "${message}")
endfunction()

execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${first} OUTPUT_QUIET RESULT_VARIABLE code)
if(code)
  fail("cannot install")
endif()
file(RENAME ${first} ${moved})

set(run ${moved}/bin/hooke-headless run two_masses --seconds 0.1 --quiet)
execute_process(COMMAND ${run} WORKING_DIRECTORY / RESULT_VARIABLE code)
if(code)
  fail("the moved program does not find its scenes: exit code ${code}")
endif()

# without that file, the program must not use another one instead
file(REMOVE ${moved}/share/hooke/scenes/two_masses.json)
execute_process(COMMAND ${run} WORKING_DIRECTORY / RESULT_VARIABLE code ERROR_VARIABLE error)
if(NOT code EQUAL 5 OR NOT error MATCHES "two_masses: no such file or shipped scene")
  fail("the moved program takes its scenes from elsewhere: exit code ${code}, ${error}")
endif()

# without any of them, it names their folder
file(REMOVE_RECURSE ${moved}/share/hooke/scenes)
file(MAKE_DIRECTORY ${moved}/share/hooke/scenes)
execute_process(COMMAND ${run} WORKING_DIRECTORY / RESULT_VARIABLE code ERROR_VARIABLE error)
if(NOT code EQUAL 5 OR NOT error MATCHES "two_masses: no such file, and no shipped scenes in [^\n]*/share/hooke/scenes\n$")
  fail("the folder without scenes is not named: exit code ${code}, ${error}")
endif()
file(REMOVE_RECURSE ${moved})
