# Builds the Debian package, checks it with lintian, and runs its programs: cmake -DBUILD=FOLDER -P package_test.cmake
cmake_minimum_required(VERSION 3.25)

string(RANDOM LENGTH 12 name)
set(place /tmp/hooke-package-${name})
set(share ${place}/root/usr/share)

# Runs a command; if it fails, the test ends with its output.
function(need what)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY / RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT code EQUAL 0)
    file(REMOVE_RECURSE ${place})
    message(FATAL_ERROR "${what}: ${code}\n${output}${errors}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

need("cpack" ${CMAKE_CPACK_COMMAND} --config ${BUILD}/CPackConfig.cmake -B ${place})
file(GLOB package ${place}/*.deb)
need("lintian" lintian --fail-on error,warning --allow-root ${package})
need("unpacking" dpkg -x ${package} ${place}/root)
need("desktop-file-validate" desktop-file-validate ${share}/applications/org.hooke.Hooke.desktop)
need("appstreamcli" appstreamcli validate --no-net ${share}/metainfo/org.hooke.Hooke.metainfo.xml)
need("man" man --warnings --local-file ${share}/man/man1/hooke.1.gz)
foreach(expected "hooke run SCENE" "--integrator ID" "velocity_verlet" "Ctrl.Shift.Z")
  if(NOT output MATCHES "${expected}")
    message(FATAL_ERROR "the man page lacks: ${expected}")
  endif()
endforeach()

# bash completion
need("completion" bash ${CMAKE_CURRENT_LIST_DIR}/completion_test.sh ${share}/bash-completion/completions/hooke)
need("the installed program" ${place}/root/usr/bin/hooke-headless run two_masses --seconds 0.1 --quiet)
need("the installed program" ${place}/root/usr/bin/hooke check two_masses --quiet)
file(REMOVE_RECURSE ${place})
