# Lists the suites of a program of GoogleTests as tests of ctest, NAME/SUITE, each run in one process: starting a program takes longer than
# most tests. What the filter NIGHTLY selects of a suite is another test, nightly/NAME/SUITE.
#   cmake -DPROGRAM=file -DNAME=name -DNIGHTLY=filter -DTIMEOUT=seconds -DOUTPUT=file -P list_suites.cmake

# The suites that the filter selects, in RESULT, and the tests of each in RESULT_SUITE.
function(suites_of filter result)
  execute_process(COMMAND ${PROGRAM} --gtest_list_tests --gtest_filter=${filter} OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY TIMEOUT 60)
  # "Suite.", then "  Test  # GetParam() = value" for each of its tests
  string(REGEX REPLACE " *#[^\n]*" "" output "${output}")
  string(REGEX MATCHALL "[^\n]+" lines "${output}")
  set(suites)
  foreach(line IN LISTS lines)
    if(line MATCHES "^([^ ]+)\\.$")
      set(suite ${CMAKE_MATCH_1})
      list(APPEND suites ${suite})
    elseif(line MATCHES "^  ([^ ]+)$")
      list(APPEND ${result}_${suite} ${suite}.${CMAKE_MATCH_1})
      set(${result}_${suite} ${${result}_${suite}} PARENT_SCOPE)
    endif()
  endforeach()
  set(${result} ${suites} PARENT_SCOPE)
endfunction()

suites_of("*" all)
set(script)
function(add_suites filter prefix properties)
  suites_of("${filter}" chosen)
  foreach(suite IN LISTS chosen)
    if(chosen_${suite} STREQUAL all_${suite})
      set(tests "${suite}.*")
    else()
      list(JOIN chosen_${suite} ":" tests)
    endif()
    string(APPEND script "add_test([==[${prefix}${suite}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${tests}]==])\n"
                         "set_tests_properties([==[${prefix}${suite}]==] PROPERTIES ${properties})\n")
  endforeach()
  set(script "${script}" PARENT_SCOPE)
endfunction()

add_suites("*-${NIGHTLY}" "${NAME}/" "TIMEOUT ${TIMEOUT}")
# several methods or parts, each of which takes as long as those of every day
math(EXPR nightly_timeout "4 * ${TIMEOUT}")
add_suites("${NIGHTLY}" "nightly/${NAME}/" "TIMEOUT ${nightly_timeout} COST 100 LABELS slow_nightly")
file(WRITE ${OUTPUT} "${script}")
