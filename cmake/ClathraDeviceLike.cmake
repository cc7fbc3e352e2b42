# clathra_device_like: what is linked to it has kernels that work on this processor as on a GPU: a lane a disc, slices as wide as
# there, and, with a Kokkos that has logical memory spaces (3.x), fields in a memory space that is not the host's. The program of
# tests device_like is built so; CLATHRA_DEVICE_LIKE builds everything so.
set(device_like_folder ${PROJECT_SOURCE_DIR}/tests/device_like)
if(Kokkos_VERSION VERSION_LESS 4)
  add_library(clathra_device_like STATIC EXCLUDE_FROM_ALL ${device_like_folder}/host_access.cpp)
  target_compile_features(clathra_device_like PUBLIC cxx_std_20)
  target_include_directories(clathra_device_like PUBLIC ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(clathra_device_like PUBLIC CLATHRA_DEVICE_LIKE CLATHRA_MEMORY_SPACE=clathra::device_like::MemorySpace)
  target_compile_options(clathra_device_like PUBLIC -include ${device_like_folder}/space.hpp)
  target_link_libraries(clathra_device_like PUBLIC Kokkos::kokkos PRIVATE clathra_flags)
else()
  add_library(clathra_device_like INTERFACE)
  target_compile_definitions(clathra_device_like INTERFACE CLATHRA_DEVICE_LIKE)
  target_link_libraries(clathra_device_like INTERFACE Kokkos::kokkos)
endif()
