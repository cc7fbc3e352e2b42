# What `cmake --install` installs, and the .deb holds: the program clathra and what belongs to it. Libraries and headers stay in the
# build: there is no public C++ API.
set(clathra_docs_folder ${CMAKE_INSTALL_DATADIR}/doc/clathra)

if(CLATHRA_IO)
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

install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/examples ${PROJECT_SOURCE_DIR}/share/papers ${PROJECT_SOURCE_DIR}/share/paraview
            ${PROJECT_SOURCE_DIR}/share/python
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
  PATTERN "*.py"
  PATTERN py.typed)
install(
  FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/CITATION.cff
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
