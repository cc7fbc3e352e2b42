# Fails when a compiled library holds a fused multiply-add (x86 or Arm): it rounds once where two operations round twice, so
# the bits would depend on where the compiler finds one. Run by ctest as
#   cmake -DOBJDUMP=<program> -DLIBRARY=<file> -P no_fma_test.cmake
cmake_minimum_required(VERSION 3.22)

set(listing ${LIBRARY}.disassembly)
execute_process(COMMAND ${OBJDUMP} -d --no-show-raw-insn ${LIBRARY} OUTPUT_FILE ${listing} COMMAND_ERROR_IS_FATAL ANY)
file(STRINGS ${listing} fused REGEX "[ \t]v?f(n?m(add|sub)|ml[as])")
file(STRINGS ${listing} multiplied REGEX "[ \t](v?mul[ps]d|fmul)" LIMIT_COUNT 1)
file(REMOVE ${listing})
if(NOT multiplied)
  message(FATAL_ERROR "no_fma: found no multiplication at all in ${LIBRARY}: is this its disassembly?")
endif()
list(LENGTH fused count)
if(count GREATER 0)
  list(GET fused 0 first)
  message(FATAL_ERROR "no_fma: ${count} fused multiply-adds in ${LIBRARY}, the first is\n${first}\n")
endif()
