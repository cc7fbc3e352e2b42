# All files that state Clathra's version, the program and its manual page state that of the project in CMakeLists.txt. Run by ctest as
#   cmake -DVERSION=<of the project> -DSOURCE=<project folder> [-DPROGRAM=<clathra>] -P version_test.cmake
cmake_minimum_required(VERSION 3.22)

# What follows the first match of a pattern in a text, up to a blank, quote or bracket, is the version.
function(check name text before)
  if(NOT text MATCHES "${before}([^] \"\n)]*)")
    message(SEND_ERROR "${name} states no version: nothing matches '${before}'")
  elseif(NOT CMAKE_MATCH_1 STREQUAL VERSION)
    message(SEND_ERROR "${name} states version ${CMAKE_MATCH_1}, CMakeLists.txt ${VERSION}")
  endif()
endfunction()

function(check_file name before)
  file(READ ${SOURCE}/${name} text)
  check(${name} "\n${text}" "${before}")
endfunction()

check_file(CHANGELOG.md "\n## \\[?") # its newest entry
check_file(CITATION.cff "\nversion: ")
check_file(share/python/pyproject.toml "\nversion = \"")
check_file(packaging/spack/package.py "\n    version\\(\"")
if(PROGRAM)
  execute_process(COMMAND ${PROGRAM} --version OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${PROGRAM} man OUTPUT_VARIABLE manual COMMAND_ERROR_IS_FATAL ANY)
  check("clathra --version" "${said}" "^clathra ")
  check("clathra man" "${manual}" "^\\.TH CLATHRA 1 \"\" \"clathra ")
endif()
