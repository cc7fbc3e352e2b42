# Fails when a compiled library holds a fused multiply-add (x86 or Arm): it rounds once where two operations round twice, so the
# bits would depend on where the compiler finds one. The library must be one that asks for none itself. Run by ctest as
#   cmake -DOBJDUMP=<program> -DLIBRARY=<file> -P no_fma_test.cmake
cmake_minimum_required(VERSION 3.22)

set(listing ${LIBRARY}.disassembly)
execute_process(COMMAND ${OBJDUMP} -d -C --no-show-raw-insn ${LIBRARY} OUTPUT_FILE ${listing} COMMAND_ERROR_IS_FATAL ANY)
file(STRINGS ${listing} lines REGEX "^[0-9a-f]+ <|[ \t]v?f(n?m(add|sub)|ml[as])")
file(STRINGS ${listing} multiplied REGEX "[ \t](v?mul[ps][ds]|fmul)" LIMIT_COUNT 1)
file(REMOVE ${listing})
if(NOT multiplied)
  message(FATAL_ERROR "no_fma: found no multiplication at all in ${LIBRARY}: is this its disassembly?")
endif()
set(function "")
foreach(line IN LISTS lines)
  if(line MATCHES "^[0-9a-f]+ <")
    set(function "${line}")
  else()
    message(FATAL_ERROR "no_fma: a fused multiply-add that nobody asked for in ${LIBRARY}: ${line}\nin ${function}\n")
  endif()
endforeach()
