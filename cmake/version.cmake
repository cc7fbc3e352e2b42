# Writes OUTPUT, a header with the VERSION and the git revision of the folder SOURCE, if its content would change.
find_program(git git)
set(hash "")
if(git)
  execute_process(
    COMMAND ${git} rev-parse --short=12 HEAD
    WORKING_DIRECTORY ${SOURCE}
    OUTPUT_VARIABLE hash
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(hash)
  execute_process(
    COMMAND ${git} status --porcelain --untracked-files=no
    WORKING_DIRECTORY ${SOURCE}
    OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes) # two programs with other changes are two programs
    execute_process(
      COMMAND ${git} diff HEAD
      WORKING_DIRECTORY ${SOURCE}
      OUTPUT_VARIABLE difference ERROR_QUIET)
    string(SHA256 digest "${difference}")
    string(SUBSTRING "${digest}" 0 8 digest)
    string(APPEND hash "-dirty-${digest}")
  endif()
else()
  set(hash "unknown")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#pragma once
#define CLATHRA_VERSION "@VERSION@"
#define CLATHRA_GIT_HASH "@hash@"
]])
