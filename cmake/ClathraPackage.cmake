# The .deb of the program: `cpack` in the build folder, or scripts/package. It holds the component `program` of
# ClathraInstall.cmake.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME clathra)
set(CPACK_PACKAGE_VENDOR "Clathra developers")
set(CPACK_PACKAGE_CONTACT "Clathra developers") # no address: what to report and how is in CONTRIBUTING.md
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "Clathra makes specimens of sand from discs, bonds them with methane hydrate and shears them between servo walls. Its results
are equal to the bit for every number of threads.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/package)
set(CPACK_STRIP_FILES ON)

set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME clathra)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3-pandas, python3-h5py")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
find_program(dpkg_shlibdeps dpkg-shlibdeps)
if(dpkg_shlibdeps)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON) # the packages of the shared libraries that the program links
endif()
include(CPack)
