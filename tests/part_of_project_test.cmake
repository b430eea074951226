# Builds a project that contains Hooke by add_subdirectory, without OpenGL, GLFW, OSMesa and ImGui, installs the library of that build, and
# runs the program: cmake -DSOURCES=FOLDER -DBUILD=FOLDER -P part_of_project_test.cmake
cmake_minimum_required(VERSION 3.25)

file(MAKE_DIRECTORY ${BUILD}/project)
file(CREATE_LINK ${SOURCES} ${BUILD}/project/hooke SYMBOLIC)
file(WRITE ${BUILD}/project/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(small LANGUAGES C CXX)
foreach(package IN ITEMS OpenGL GLEW glfw3 Freetype CLI11)
  set(CMAKE_DISABLE_FIND_PACKAGE_\${package} ON)
endforeach()
add_subdirectory(hooke)
if(TARGET hooke OR TARGET hooke-headless OR TARGET hooke_ui)
  message(FATAL_ERROR \"more than the library is built\")
endif()
add_executable(cpp_program program.cpp)
target_link_libraries(cpp_program PRIVATE hooke::hooke)
add_executable(c_program program.c)
target_link_libraries(c_program PRIVATE hooke::hooke)
")
file(WRITE ${BUILD}/project/program.cpp "#include <hooke/hooke.h>
#include <cstdio>
int main() {
  hooke::v1::Simulation simulation(hooke::v1::Scene::load(\"two_masses\"));
  simulation.step(0.5);
  std::printf(\"%016llx\\n\", static_cast<unsigned long long>(simulation.hash()));
}
")
file(WRITE ${BUILD}/project/program.c "#include <hooke/hooke_c.h>
#include <stdio.h>
int main(void) {
  hooke_scene* scene = hooke_scene_load(\"two_masses\");
  hooke_simulation* simulation = scene ? hooke_simulation_new(scene, HOOKE_ACCURACY_OFF) : NULL;
  if (!simulation || hooke_simulation_step(simulation, 0.5) != 1) return puts(hooke_error()), 1;
  printf(\"%016llx\\n\", (unsigned long long)hooke_simulation_hash(simulation));
  hooke_simulation_free(simulation);
  hooke_scene_free(scene);
  return 0;
}
")

function(need what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${what}: ${code}\n${output}${errors}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

need("configure" ${CMAKE_COMMAND} -G Ninja -S ${BUILD}/project -B ${BUILD}/build -DHOOKE_UNITY_BUILD=ON
     "-DCMAKE_CXX_FLAGS=-O1 -DHWY_COMPILE_ONLY_STATIC" ${OPTIONS})
# FetchContent adds the same folder; what it makes available is the target
file(WRITE ${BUILD}/fetching/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(fetching LANGUAGES CXX)
include(FetchContent)
FetchContent_Declare(hooke SOURCE_DIR \${CMAKE_CURRENT_SOURCE_DIR}/../project/hooke)
FetchContent_MakeAvailable(hooke)
if(NOT TARGET hooke::hooke OR TARGET hooke-headless)
  message(FATAL_ERROR \"not the library alone\")
endif()
")
need("configure with FetchContent" ${CMAKE_COMMAND} -G Ninja -S ${BUILD}/fetching -B ${BUILD}/fetching/build)
file(REMOVE_RECURSE ${BUILD}/fetching)
need("build" ${CMAKE_COMMAND} --build ${BUILD}/build --target cpp_program c_program)
need("the program in C++" ${BUILD}/build/cpp_program)
set(expected "${output}")
need("the program in C" ${BUILD}/build/c_program)
if(NOT output STREQUAL expected)
  message(FATAL_ERROR "the hashes differ: ${expected} and ${output}")
endif()
need("install" ${CMAKE_COMMAND} --install ${BUILD}/build --prefix ${BUILD}/installed --component library)
file(GLOB_RECURSE installed ${BUILD}/installed/*libhooke.so.1)
if(NOT installed)
  message(FATAL_ERROR "the library was not installed")
endif()
file(REMOVE_RECURSE ${BUILD}/installed)
