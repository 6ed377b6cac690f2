# ringlet_add_suites(target folder [VARIABLE=VALUE ...]): one ctest entry for each GoogleTest suite of the target, named folder/Suite. The tests of a
# suite share a process, and with it the device and its compiled kernels. The suites are read from the program when ctest starts.
# They run with the variables in their environment.
#   RINGLET_LONG_SUITES  a list of "folder/Suite=seconds". ctest starts the longest first, so that none is left over at the end.
#   RINGLET_LONG_FORM    the entries that have the label `long`, which the quick form of scripts/test.sh leaves out.
set(RINGLET_LIST_SUITES ${CMAKE_CURRENT_LIST_DIR}/list_suites.cmake)

function(ringlet_add_suites target folder)
  set(script ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  file(GENERATE OUTPUT ${script} CONTENT "set(program [[$<TARGET_FILE:${target}>]])
set(folder [[${folder}]])
set(environment [[RINGLET_SKIP_CODE=77;${ARGN}]])
set(long_suites [[${RINGLET_LONG_SUITES}]])
set(long_form [[${RINGLET_LONG_FORM}]])
include([[${RINGLET_LIST_SUITES}]])
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()
