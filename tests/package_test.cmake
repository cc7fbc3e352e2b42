# Packs the build tree as a .deb and looks at its list of contents. Run by ctest as
#   cmake -DBUILD=<build folder> -DCPACK=<cpack> -DDPKG_DEB=<dpkg-deb> -DVERSION=<of the project> -DFOLDER=<scratch> -P package_test.cmake
cmake_minimum_required(VERSION 3.22)

file(REMOVE_RECURSE ${FOLDER})
execute_process(
  COMMAND ${CPACK} --config ${BUILD}/CPackConfig.cmake -B ${FOLDER}
  WORKING_DIRECTORY ${BUILD}
  OUTPUT_VARIABLE output
  ERROR_VARIABLE output
  RESULT_VARIABLE code)
file(GLOB package ${FOLDER}/clathra_*.deb)
if(code OR NOT package)
  message(FATAL_ERROR "cpack ended with ${code} and made '${package}':\n${output}")
endif()

# README gives apt-get what scripts/package prints: without / or ./ before it that would be the name of a package.
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/../scripts/package lines)
list(POP_BACK lines printed)
if(NOT printed STREQUAL "ls \"$project\"/build/package/package/*.deb")
  message(SEND_ERROR "scripts/package does not end with the absolute path of the package, but: ${printed}")
endif()

execute_process(COMMAND ${DPKG_DEB} --contents ${package} OUTPUT_VARIABLE contents COMMAND_ERROR_IS_FATAL ANY)
foreach(
  path
  bin/clathra
  share/man/man1/clathra.1
  share/bash-completion/completions/clathra
  share/clathra/examples/quick.toml
  share/clathra/python/curves.py
  lib/python3/dist-packages/clathra/__init__.py
  share/clathra/examples/paper/s55-1mpa.toml
  share/clathra/examples/papers/tiny.toml
  share/clathra/papers/jiang-2017.toml
  share/doc/clathra/copyright
  share/doc/clathra/README.md)
  if(NOT contents MATCHES " \\./usr/${path}\n")
    message(SEND_ERROR "the package lacks /usr/${path}")
  endif()
endforeach()
string(REGEX REPLACE "[^\n]* \\./usr/lib/(python3/[^\n]*)?\n" "" others "${contents}")
if(others MATCHES "[^\n]*(/include/|/lib/|\\.a\n)[^\n]*")
  message(SEND_ERROR "the package holds what belongs to development: ${CMAKE_MATCH_0}")
endif()
foreach(line "-rwxr-xr-x root/root [^\n]*/usr/bin/clathra\n" "-rw-r--r-- root/root [^\n]*/usr/share/man/man1/clathra.1\n")
  if(NOT contents MATCHES "${line}")
    message(SEND_ERROR "owner or rights are wrong, wanted ${line}")
  endif()
endforeach()

execute_process(COMMAND ${DPKG_DEB} --extract ${package} ${FOLDER}/unpacked COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${FOLDER}/unpacked/usr/bin/clathra --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
if(NOT help MATCHES "docs/NAME.md: [^\n]*/unpacked/usr/share/doc/clathra\n" OR NOT EXISTS ${FOLDER}/unpacked/usr/share/doc/clathra/reference/files.md)
  message(SEND_ERROR "the help does not say where the pages are:\n${help}")
endif()

execute_process(COMMAND ${DPKG_DEB} --field ${package} OUTPUT_VARIABLE fields COMMAND_ERROR_IS_FATAL ANY)
foreach(field "Package: clathra" "Version: ${VERSION}" "Maintainer: Clathra developers" "Depends: [^\n]*libc6 [^\n]*libhdf5[^\n]*")
  if(NOT fields MATCHES "(^|\n)${field}\n")
    message(SEND_ERROR "the package lacks the field ${field}:\n${fields}")
  endif()
endforeach()
