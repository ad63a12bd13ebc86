# cmake -D SOURCE_DIR=... -D VERSION=... -D INPUT=version.hpp.in -D OUTPUT=version.hpp -P version.cmake
#
# Writes OUTPUT if its text changes. The commit is "unknown" when git is absent, when SOURCE_DIR is no clone (a tarball)
# and when it merely lies inside another repository, whose commit would say nothing about this code.

set(COMMIT "unknown")
find_program(GIT git)
if(GIT)
  # A clone owned by another user is common in containers; reading its HEAD runs none of its hooks.
  set(git ${GIT} -c safe.directory=* -c core.fsmonitor=false -C ${SOURCE_DIR})
  execute_process(
    COMMAND ${git} rev-parse --show-prefix
    OUTPUT_VARIABLE prefix
    RESULT_VARIABLE outside
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT outside AND prefix STREQUAL "")
    execute_process(
      COMMAND ${git} describe --always --abbrev=40 --match= --dirty
      OUTPUT_VARIABLE described
      RESULT_VARIABLE failed
      OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(NOT failed AND NOT described STREQUAL "")
      set(COMMIT "${described}")
    endif()
  endif()
endif()

configure_file(${INPUT} ${OUTPUT} @ONLY)
