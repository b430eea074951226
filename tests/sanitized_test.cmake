# The tests of the module base, which reads all JSON text, numbers and files, under the address and undefined-behavior sanitizers; all
# other tests are in scripts/test-sanitized, whose build takes an hour of CPU time: cmake -DSOURCES=FOLDER -DBUILD=FOLDER -P sanitized_test.cmake
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND ${CMAKE_COMMAND} --preset asan -S ${SOURCES} -B ${BUILD} -DHOOKE_UNITY_BUILD=ON WORKING_DIRECTORY ${SOURCES}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BUILD} --target base_test -- --quiet COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${BUILD}/tests/base_test --gtest_brief=1 COMMAND_ERROR_IS_FATAL ANY)
