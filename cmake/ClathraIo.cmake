# Looks for the libraries of src/io and drivers, and for Eigen and Boost.Math, with which domain measures what they show. CLATHRA_IO
# says whether all are here; without it kernels, domain, their tests and the benches are still built.
find_package(PkgConfig QUIET)
find_package(HDF5 QUIET COMPONENTS C)
find_package(PNG QUIET)
find_package(Eigen3 3.3 QUIET CONFIG)
find_package(Boost 1.66 QUIET)
find_package(fmt CONFIG QUIET)
find_package(CLI11 CONFIG QUIET)
find_package(nlohmann_json CONFIG QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(TOMLPLUSPLUS QUIET IMPORTED_TARGET tomlplusplus)
  pkg_check_modules(XXHASH QUIET IMPORTED_TARGET libxxhash)
endif()

set(missing "")
foreach(library HDF5 PNG Eigen3 Boost fmt CLI11 nlohmann_json TOMLPLUSPLUS XXHASH)
  if(NOT ${library}_FOUND)
    list(APPEND missing ${library})
  endif()
endforeach()
if(missing)
  list(JOIN missing ", " missing)
  message(STATUS "Clathra: no io library and no driver, not found: ${missing}")
  set(CLATHRA_IO OFF)
else()
  set(CLATHRA_IO ON)
endif()

# For the small linear algebra and the statistics of domain/measurement. No header shows them, so what is installed does not need
# them; without vectors of its own Eigen's results are the same on all processors. Boost.Math is headers only.
set(clathra_measurement_sources "fabric|principal_axes|strain_field|grain_strain|strength_fit|paired_strength|claims|confidence")
if(Eigen3_FOUND AND Boost_FOUND)
  set(CLATHRA_MEASUREMENT ON)
  add_library(clathra_measurement_libraries INTERFACE)
  target_link_libraries(clathra_measurement_libraries INTERFACE Eigen3::Eigen Boost::headers)
  target_compile_definitions(clathra_measurement_libraries INTERFACE EIGEN_DONT_VECTORIZE)
  if(CLATHRA_DEVICE STREQUAL "CUDA") # measured on the host only
    target_compile_definitions(clathra_measurement_libraries INTERFACE EIGEN_NO_CUDA)
  endif()
else()
  set(CLATHRA_MEASUREMENT OFF)
endif()

if(CLATHRA_IO)
  add_library(clathra_io_libraries INTERFACE)
  target_include_directories(clathra_io_libraries SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
  # TOML_HEADER_ONLY=0: the parser comes compiled, in the shared library, instead of once more in each of our sources.
  target_compile_definitions(clathra_io_libraries INTERFACE ${HDF5_DEFINITIONS} TOML_HEADER_ONLY=0)
  target_link_libraries(
    clathra_io_libraries INTERFACE ${HDF5_C_LIBRARIES} PNG::PNG PkgConfig::TOMLPLUSPLUS PkgConfig::XXHASH fmt::fmt
                                   nlohmann_json::nlohmann_json)
  if(CLATHRA_DEVICE STREQUAL "CUDA")
    target_compile_definitions(clathra_io_libraries INTERFACE FMT_USE_CONSTEXPR=1) # fmt 9 does not expect it of nvcc
  endif()
  if(HDF5_IS_PARALLEL) # its headers include those of MPI
    find_package(MPI REQUIRED COMPONENTS CXX)
    target_link_libraries(clathra_io_libraries INTERFACE MPI::MPI_CXX)
    target_compile_definitions(clathra_io_libraries INTERFACE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
  endif()
endif()
