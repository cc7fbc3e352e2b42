# Makes the target Kokkos::kokkos and sets Kokkos_VERSION and, but for the third, Kokkos_DIR. Sources of Kokkos, in this order:
#   1. an installed one (>= 3.4.1) that has OpenMP: Debian's libtrilinos-kokkos-dev is Serial only and is refused. Where
#      CLATHRA_DEVICE names a GPU it must be one for that, and there is no other source.
#   2. the one built earlier, or now, into the cache folder from Debian's source package (scripts/kokkos)
#   3. the upstream release, pinned by its hash
# CLATHRA_KOKKOS names one of them to skip the search.

set(CLATHRA_KOKKOS auto CACHE STRING "Where Kokkos comes from: auto, installed, debian or upstream")
set_property(CACHE CLATHRA_KOKKOS PROPERTY STRINGS auto installed debian upstream)
set(CLATHRA_KOKKOS_URL "https://github.com/kokkos/kokkos/releases/download/4.7.01/kokkos-4.7.01.tar.gz"
    CACHE STRING "Upstream release of Kokkos")
set(CLATHRA_KOKKOS_SHA256 404cf33e76159e83b8b4ad5d86f6899d442b5da4624820ab457412116cdcd201
    CACHE STRING "SHA-256 of the upstream release")
set(CLATHRA_DEVICE "" CACHE STRING "What kernels run on: CUDA or HIP by a Kokkos for it (docs/howto/gpu.md), empty for the processor")
set_property(CACHE CLATHRA_DEVICE PROPERTY STRINGS "" CUDA HIP)
mark_as_advanced(CLATHRA_KOKKOS_URL CLATHRA_KOKKOS_SHA256)

set(kokkos_source "")

if(CLATHRA_DEVICE OR CLATHRA_KOKKOS MATCHES "^(auto|installed)$")
  # The probe looks in a folder scope of its own, so that the targets of a refused Kokkos do not stay behind.
  add_subdirectory(${PROJECT_SOURCE_DIR}/cmake/kokkos_probe ${PROJECT_BINARY_DIR}/kokkos_probe)
  if(kokkos_probe_accepts)
    set(kokkos_source "installed in ${Kokkos_DIR}")
    find_package(Kokkos 3.4.1 CONFIG REQUIRED)
    if(CLATHRA_DEVICE STREQUAL "CUDA" AND Kokkos_VERSION VERSION_GREATER_EQUAL 4.6 AND NOT "IMPL_VIEW_LEGACY" IN_LIST Kokkos_OPTIONS)
      message(WARNING "Kokkos: the views of this one have another layout on the GPU than on the host where nvcc 13.0 and GCC 12 compile "
                      "them as C++20, and kernels get wrong addresses (the test KernelArguments compares the two). Kokkos built with "
                      "-DKokkos_ENABLE_IMPL_VIEW_LEGACY=ON has others.")
    endif()
  else()
    unset(Kokkos_DIR CACHE)
    if(CLATHRA_DEVICE)
      message(FATAL_ERROR "Kokkos: ${kokkos_probe_answer}. Kokkos_ROOT names the folder that one with ${CLATHRA_DEVICE} was installed to.")
    endif()
    if(CLATHRA_KOKKOS STREQUAL "installed")
      message(FATAL_ERROR "Kokkos: ${kokkos_probe_answer}. -DCLATHRA_REQUIRE_OPENMP=OFF accepts a Serial one.")
    endif()
    message(STATUS "Kokkos: ${kokkos_probe_answer}")
  endif()
endif()

if(NOT kokkos_source AND CLATHRA_KOKKOS MATCHES "^(auto|debian)$")
  execute_process(
    COMMAND ${PROJECT_SOURCE_DIR}/scripts/kokkos ${CMAKE_CXX_COMPILER} ${CMAKE_CXX_COMPILER_ID}-${CMAKE_CXX_COMPILER_VERSION}
    OUTPUT_VARIABLE kokkos_prefix
    OUTPUT_STRIP_TRAILING_WHITESPACE
    RESULT_VARIABLE kokkos_failed)
  if(NOT kokkos_failed)
    set(kokkos_source "${kokkos_prefix}")
    find_package(Kokkos 3.4.1 CONFIG REQUIRED PATHS ${kokkos_prefix} NO_DEFAULT_PATH)
  elseif(CLATHRA_KOKKOS STREQUAL "debian")
    message(FATAL_ERROR "Kokkos: scripts/kokkos could not build Debian's source package, see above")
  endif()
endif()

if(NOT kokkos_source)
  message(STATUS "Kokkos: fetching the upstream release")
  include(FetchContent)
  set(Kokkos_ENABLE_SERIAL ON CACHE BOOL "Kokkos' Serial backend")
  set(Kokkos_ENABLE_OPENMP ON CACHE BOOL "Kokkos' OpenMP backend")
  if(POLICY CMP0135)
    cmake_policy(SET CMP0135 NEW) # unpacked files are as old as their unpacking
  endif()
  FetchContent_Declare(
    Kokkos
    URL ${CLATHRA_KOKKOS_URL}
    URL_HASH SHA256=${CLATHRA_KOKKOS_SHA256})
  FetchContent_MakeAvailable(Kokkos)
  get_directory_property(Kokkos_VERSION DIRECTORY ${kokkos_SOURCE_DIR} DEFINITION Kokkos_VERSION)
  foreach(part kokkoscore kokkoscontainers kokkosalgorithms kokkossimd) # our warnings are for our own code
    if(TARGET ${part})
      get_target_property(folders ${part} INTERFACE_INCLUDE_DIRECTORIES)
      set_target_properties(${part} PROPERTIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${folders}")
    endif()
  endforeach()
  set(kokkos_source "upstream ${CLATHRA_KOKKOS_URL}")
endif()
message(STATUS "Kokkos: ${kokkos_source}")
