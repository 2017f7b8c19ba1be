# Writes a CTest script, FILE, with one test per suite of the GoogleTest program PROGRAM, named
# FOLDER.SUITE. All tests of a suite run in one process, which writes results to
# RESULTS/FOLDER.SUITE.xml. Suites that match the regular expression SLOW start first and have the
# label "slow"; the other suites have the label "fast". With ONE_BY_ONE, each GoogleTest test is a
# separate CTest test with the label "window", and SLOW is compared with SUITE.TEST. All tests run
# with ENVIRONMENT.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests
  OUTPUT_VARIABLE listing RESULT_VARIABLE result ERROR_VARIABLE errors TIMEOUT 120)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} cannot list its tests: ${result}\n${errors}")
endif()

set(script "# Written by tools/cmake/DiscoverSuites.cmake.\n")
# add(NAME FILTER LABEL COST): adds a CTest test that runs the GoogleTest tests that match FILTER.
function(add name filter label cost)
  string(REPLACE "/" "-" file ${name})
  string(APPEND script "add_test([==[${name}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${filter}]==])\n"
    "set_tests_properties([==[${name}]==] PROPERTIES LABELS ${label} COST ${cost} TIMEOUT ${TIMEOUT}\n"
    "  ENVIRONMENT [==[GTEST_OUTPUT=xml:${RESULTS}/${file}.xml;${ENVIRONMENT}]==])\n")
  set(script "${script}" PARENT_SCOPE)
endfunction()

# Remove the parameters of tests, which follow a #, because their brackets and semicolons would
# split CMake lists.
string(REGEX REPLACE " *#[^\n]*" "" listing "${listing}")
string(REPLACE "\n" ";" lines "${listing}")
foreach(line IN LISTS lines)
  if(line MATCHES "^([^ ]+)\\.$")
    set(suite ${CMAKE_MATCH_1})
    if(ONE_BY_ONE)
      continue()
    endif()
    set(label fast)
    set(cost 1)
    if(SLOW AND suite MATCHES "${SLOW}")
      set(label slow)
      set(cost 100)
    endif()
    add(${FOLDER}.${suite} "${suite}.*" ${label} ${cost})
  elseif(ONE_BY_ONE AND line MATCHES "^  ([^ ]+)$")
    set(test ${suite}.${CMAKE_MATCH_1})
    set(cost 1)
    if(SLOW AND test MATCHES "${SLOW}")
      set(cost 100)
    endif()
    add(${FOLDER}.${test} ${test} window ${cost})
  endif()
endforeach()
file(WRITE ${FILE} "${script}")
