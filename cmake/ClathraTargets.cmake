include(GNUInstallDirs)

# clathra_precompile(TARGET headers...): reads headers of libraries that nearly every source of a target includes once for all of
# them (a source that includes nothing but Kokkos takes 1.5 s, CLI11 7 s). Not for devices, whose compilers read a source twice, each time in its own way.
function(clathra_precompile target)
  if(NOT CLATHRA_DEVICE AND NOT CLATHRA_DEVICE_LIKE)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# clathra_compile_quickly(TARGET): with little optimisation in a build that has much, for what no run spends time in: four files of
# the drivers compile in 54 to 74 % of the time, the tests device_like in half of it.
function(clathra_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-O1>)
endfunction()

# clathra_compile_together(TARGET [ALONE sources...]): up to 16 sources of a target as one, where CLATHRA_COMPILE_TOGETHER says so;
# the largest then takes 1.2 GB. Not the kernels, whose machine code is measured, and nothing for devices.
function(clathra_compile_together target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "ALONE")
  if(CLATHRA_COMPILE_TOGETHER AND NOT CLATHRA_DEVICE)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
    set_source_files_properties(${arg_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()

# They bring in names, of toml++ and of two enumerations, that would hide those of other sources.
set(clathra_io_alone ${PROJECT_SOURCE_DIR}/src/io/scene/guarded_toml.cpp ${PROJECT_SOURCE_DIR}/src/io/scene/schema.cpp)

# clathra_layer(NAME LINK targets... [EXCLUDE regex]): the library of the current folder, from all its *.cpp and those of its
# subfolders. A folder without sources makes an INTERFACE library, so that what stands above it can be configured.
function(clathra_layer name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "EXCLUDE" "LINK")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(arg_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX ${arg_EXCLUDE})
  endif()
  set(include_folder ${PROJECT_SOURCE_DIR}/src)
  if(sources)
    add_library(${name} STATIC ${sources})
    target_include_directories(${name} PUBLIC ${include_folder})
    target_compile_features(${name} PUBLIC cxx_std_20)
    target_link_libraries(${name} PUBLIC ${arg_LINK} PRIVATE clathra_flags)
    clathra_precompile(${name} <Kokkos_Core.hpp>)
  else()
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE ${include_folder})
    target_link_libraries(${name} INTERFACE ${arg_LINK})
  endif()
endfunction()
