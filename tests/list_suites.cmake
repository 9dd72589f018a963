# Writes the tests of one program of the quick suites for ctest, after it is built: a test a GoogleTest suite.
#
# PROGRAM what has the cases, FILE what ctest reads, LONG the suites for tests/run --long, PROPERTIES of each test.
# A process costs 5 to 10 ms, and 60 where it makes a GL context: more than most of these cases do.
cmake_minimum_required(VERSION 3.25)
get_filename_component(PROGRAM_NAME ${PROGRAM} NAME)
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listed}")
string(REPLACE ";" " " PROPERTIES "${PROPERTIES}")
set(text)
foreach(suite ${suites})
    string(REGEX REPLACE "[\n.]" "" suite ${suite})
    set(name "${PROGRAM_NAME}.${suite}")  # two programs may have one of the same name
    set(label quick)
    if(suite IN_LIST LONG)
        set(label long TIMEOUT 1800)
    endif()
    list(JOIN label " " label)
    string(APPEND text "add_test(\"${name}\" \"${PROGRAM}\" \"--gtest_filter=${suite}.*\")\n"
        "set_tests_properties(\"${name}\" PROPERTIES ${PROPERTIES} LABELS ${label})\n")
endforeach()
file(WRITE ${FILE} "${text}")
