# Compile flags of our own targets: link clathra_flags PRIVATE.
add_library(clathra_flags INTERFACE)
target_compile_features(clathra_flags INTERFACE cxx_std_20)

# The determinism contract: the state after a run is equal to the bit for every number of threads, every order of the
# input and every instruction set of one architecture. So: no contraction into fused multiply-adds (whether the compiler
# finds one depends on the vector width and on inlining), and never -ffast-math, -Ofast or -fassociative-math (sums would
# be taken in another order). Mixed precision asks by name for the fused operations that it has (multiply_add() in
# src/kernels/lane.hpp), which are the same everywhere. The two flags below do not change any result: they only drop errno and the floating-point
# exception flags, which we do not read and which keep loops with sqrt and with selects from being vectorised.
target_compile_options(clathra_flags INTERFACE -ffp-contract=off -fno-math-errno -fno-trapping-math)
# GCC (12 at least) contracts neighbouring statements like x = a * b - c, y = d * e + f all the same: its vectoriser of
# straight code makes one vfmaddsub of them and does not ask -ffp-contract. The tests no_fma watch the machine code.
target_compile_options(clathra_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)

target_compile_options(
  clathra_flags INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
                          -Woverloaded-virtual $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
# What a source calls its own is global to those compiled with it: there only names inside functions count.
set(together $<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>)
target_compile_options(clathra_flags INTERFACE $<$<NOT:${together}>:-Wshadow>
                                               $<$<AND:${together},$<CXX_COMPILER_ID:GNU>>:-Wshadow=local>)

# The same contract on a GPU. A fused operation would round the two sides of a pair differently, and a bond could break on one
# side only. Whether host code is called from a kernel is no matter of taste: such a kernel does something else or nothing.
if(CLATHRA_DEVICE STREQUAL "CUDA")
  # The parentheses are those that nvcc puts around names of pointers to members before GCC reads its output.
  target_compile_options(clathra_flags INTERFACE -fmad=false -Werror=cross-execution-space-call -Wno-parentheses)
endif()

# Which instruction set: that of this machine; or any machine of its kind, where x86 processors have had AVX2 and fused operations
# since 2013 and 2015, and without the latter mixed precision, the default, calls a function for each; or what CMAKE_CXX_FLAGS say.
# Not for a GPU's host, where nothing is vectorised and nvcc does not read all that a processor has.
if(NOT CLATHRA_DEVICE)
  include(CheckCXXCompilerFlag)
  include(CheckCXXSourceCompiles)
  set(instruction_set "")
  if(CLATHRA_NATIVE)
    set(instruction_set -march=native)
  elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT CMAKE_CXX_FLAGS MATCHES "-march=")
    set(instruction_set -march=x86-64-v3)
  endif()
  if(instruction_set)
    string(MAKE_C_IDENTIFIER CLATHRA_HAS${instruction_set} has_instruction_set)
    check_cxx_compiler_flag(${instruction_set} ${has_instruction_set})
    if(${has_instruction_set})
      target_compile_options(clathra_flags INTERFACE ${instruction_set})
      set(CMAKE_REQUIRED_FLAGS ${instruction_set})
    endif()
  endif()
  check_cxx_source_compiles("#ifndef __AVX512F__\n#error\n#endif\nint main() {}" CLATHRA_HAS_AVX512)
  unset(CMAKE_REQUIRED_FLAGS)
  if(CLATHRA_HAS_AVX512)
    target_compile_options(clathra_flags INTERFACE -mprefer-vector-width=512)
  endif()
endif()

if(CLATHRA_SANITIZE)
  target_compile_options(
    clathra_flags INTERFACE -fsanitize=${CLATHRA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU") # where variables live is not asked for, and takes three quarters of the time of forces_mixed.cpp
    target_compile_options(clathra_flags INTERFACE -fno-var-tracking)
  endif()
  target_link_options(clathra_flags INTERFACE -fsanitize=${CLATHRA_SANITIZE})
endif()
