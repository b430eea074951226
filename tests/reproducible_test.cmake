# Builds two libraries, which contain assertions, from copies of the sources in two folders, and compares them byte by byte:
# cmake -DSOURCES=FOLDER -DBUILD=FOLDER -P reproducible_test.cmake. scripts/test-release compares the packages of two such builds.
cmake_minimum_required(VERSION 3.25)

function(need what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${what}: ${code}\n${output}")
  endif()
endfunction()

foreach(folder IN ITEMS ${BUILD}/one ${BUILD}/another/place)
  file(REMOVE_RECURSE ${folder})
  foreach(part IN ITEMS CMakeLists.txt CHANGELOG.md LICENSE README.md assets cmake packaging src)
    file(COPY ${SOURCES}/${part} DESTINATION ${folder})
  endforeach()
  need("configure" ${CMAKE_COMMAND} -G Ninja -S ${folder} -B ${folder}/build -DCMAKE_BUILD_TYPE=Release -DHOOKE_LIBRARY_ONLY=ON -DBUILD_TESTING=OFF
       -DHOOKE_UNITY_BUILD=ON -DCMAKE_CXX_FLAGS_RELEASE=-O1)
  need("build" ${CMAKE_COMMAND} --build ${folder}/build --target hooke_model)
endforeach()
foreach(library IN ITEMS base model)
  need("hooke_${library} of two folders" ${CMAKE_COMMAND} -E compare_files ${BUILD}/one/build/src/libhooke_${library}.a
       ${BUILD}/another/place/build/src/libhooke_${library}.a)
endforeach()
file(REMOVE_RECURSE ${BUILD})
