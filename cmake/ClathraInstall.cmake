# What `cmake --install` installs, in two components: `program` (the program clathra and what belongs to it, also the content
# of the .deb) and `development` (libraries, headers and the CMake package Clathra).
include(CMakePackageConfigHelpers)
set(clathra_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Clathra)
set(clathra_docs_folder ${CMAKE_INSTALL_DATADIR}/doc/clathra)

# clathra_install_layer(LAYER EXPORT): the library clathra_LAYER as Clathra::LAYER, and its headers.
function(clathra_install_layer layer export)
  set_target_properties(clathra_${layer} PROPERTIES EXPORT_NAME ${layer})
  install(TARGETS clathra_${layer} EXPORT ${export} COMPONENT development ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(
    DIRECTORY ${PROJECT_SOURCE_DIR}/src/${layer}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/clathra
    COMPONENT development
    FILES_MATCHING
    PATTERN "*.hpp")
endfunction()

clathra_install_layer(kernels ClathraTargets)
clathra_install_layer(domain ClathraTargets)
# The flags are linked privately, but a static library names what it links. They are also what makes code that is compiled
# elsewhere give the same bits: Clathra::flags.
set_target_properties(clathra_flags PROPERTIES EXPORT_NAME flags)
install(TARGETS clathra_flags EXPORT ClathraTargets)
install(EXPORT ClathraTargets NAMESPACE Clathra:: DESTINATION ${clathra_package_folder} COMPONENT development)

if(CLATHRA_IO)
  clathra_install_layer(io ClathraIoTargets)
  set_target_properties(clathra_io_libraries PROPERTIES EXPORT_NAME io_libraries)
  install(TARGETS clathra_io_libraries EXPORT ClathraIoTargets)
  install(EXPORT ClathraIoTargets NAMESPACE Clathra:: DESTINATION ${clathra_package_folder} COMPONENT development)
  install(TARGETS clathra RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  if(TARGET clathra_manual)
    install(
      FILES ${PROJECT_BINARY_DIR}/manual/clathra.1
      DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
      COMPONENT program)
    install(
      FILES ${PROJECT_BINARY_DIR}/manual/clathra
      DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
      COMPONENT program)
  endif()
endif()

configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/ClathraConfig.cmake.in ${PROJECT_BINARY_DIR}/ClathraConfig.cmake
  INSTALL_DESTINATION ${clathra_package_folder} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ClathraConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(
  FILES ${PROJECT_BINARY_DIR}/ClathraConfig.cmake ${PROJECT_BINARY_DIR}/ClathraConfigVersion.cmake
  DESTINATION ${clathra_package_folder}
  COMPONENT development)

install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/examples ${PROJECT_SOURCE_DIR}/share/paraview ${PROJECT_SOURCE_DIR}/share/python
  DESTINATION ${CMAKE_INSTALL_DATADIR}/clathra
  COMPONENT program
  PATTERN __pycache__ EXCLUDE
  PATTERN share/python/clathra EXCLUDE)
# The Python package, where the system's Python finds it once the prefix is /usr.
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/share/python/clathra
  DESTINATION lib/python3/dist-packages
  COMPONENT program
  FILES_MATCHING
  PATTERN "*.py")
install(
  FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CITATION.cff
  DESTINATION ${clathra_docs_folder}
  COMPONENT program)
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/docs/
  DESTINATION ${clathra_docs_folder}
  COMPONENT program)
install(
  FILES ${PROJECT_SOURCE_DIR}/LICENSE
  DESTINATION ${clathra_docs_folder}
  RENAME copyright # the name that Debian looks for
  COMPONENT program)
