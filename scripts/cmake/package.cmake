# What `cmake --install` puts where, and the Debian package that `cpack` makes of it (scripts/prove_deb).
include(GNUInstallDirs)
install(TARGETS formwork arcsim RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

# Manual page and completion are written by the program just built, from what its help says.
add_custom_command(TARGET formwork POST_BUILD
    COMMAND formwork manual -o ${CMAKE_BINARY_DIR}/formwork.1
    COMMAND formwork manual --bash-completion -o ${CMAKE_BINARY_DIR}/formwork.bash)
install(FILES ${CMAKE_BINARY_DIR}/formwork.1 ${CMAKE_SOURCE_DIR}/docs/arcsim.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${CMAKE_BINARY_DIR}/formwork.bash RENAME formwork
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)

install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN "*.md" PATTERN "*.png")
install(DIRECTORY conf meshes DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples FILES_MATCHING PATTERN "*.json" PATTERN "*.obj" PATTERN "*.csv")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the formwork project")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)   # the libraries' packages, found by dpkg-shlibdeps
include(CPack)
