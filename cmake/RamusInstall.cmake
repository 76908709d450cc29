# `cmake --install`: the program, the demo tree where the program looks for it (../share/ramus), and what a desktop wants
# to know: menu entry, icon, file types, manual page. The program finds its files from where it is, so the whole
# installation can be moved.
include(GNUInstallDirs)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # what is installed can be built alone: scripts/build ramus
set(RAMUS_DESKTOP ${PROJECT_SOURCE_DIR}/assets/desktop)

install(TARGETS ramus RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET ramus-mpi)
  install(TARGETS ramus-mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(FILES ${PROJECT_SOURCE_DIR}/assets/liver_portal_vein.swc DESTINATION ${CMAKE_INSTALL_DATADIR}/ramus)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/workflow DESTINATION ${CMAKE_INSTALL_DATADIR}/ramus USE_SOURCE_PERMISSIONS
        PATTERN __pycache__ EXCLUDE)
install(FILES ${RAMUS_DESKTOP}/org.ramus.Ramus.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES ${RAMUS_DESKTOP}/org.ramus.Ramus.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)
install(FILES ${RAMUS_DESKTOP}/org.ramus.Ramus.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
foreach(size 48 128)
  install(FILES ${RAMUS_DESKTOP}/org.ramus.Ramus-${size}.png RENAME org.ramus.Ramus.png
          DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/${size}x${size}/apps)
endforeach()
configure_file(${RAMUS_DESKTOP}/ramus.1.in ${CMAKE_BINARY_DIR}/ramus.1 @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/ramus.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
