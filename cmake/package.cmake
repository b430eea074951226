# Desktop integration files and the Debian package: cpack --config build/release/CPackConfig.cmake.

find_program(GZIP gzip REQUIRED)
set(id org.hooke.Hooke)
set(packaging ${PROJECT_SOURCE_DIR}/packaging)
set(made ${PROJECT_BINARY_DIR}/package)
include(cmake/releases.cmake)
configure_file(${packaging}/${id}.metainfo.xml.in ${made}/${id}.metainfo.xml @ONLY)
file(CONFIGURE OUTPUT ${made}/changelog CONTENT "${debian_changelog}\n" @ONLY)

# Compressed without timestamps, so that the same sources give the same package.
add_custom_command(
  OUTPUT ${made}/hooke.1.gz ${made}/hooke.bash ${made}/changelog.gz
  COMMAND make_manual man > ${made}/hooke.1
  COMMAND ${GZIP} -9nf ${made}/hooke.1
  COMMAND make_manual bash > ${made}/hooke.bash
  COMMAND ${GZIP} -9nkf ${made}/changelog
  DEPENDS make_manual ${made}/changelog
  VERBATIM
)
add_custom_target(package_files ALL DEPENDS ${made}/hooke.1.gz)

install(FILES ${made}/hooke.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${made}/hooke.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 RENAME hooke-headless.1.gz)
install(FILES ${made}/hooke.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME hooke)
install(FILES ${made}/hooke.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME hooke-headless)
install(FILES ${packaging}/${id}.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES ${packaging}/${id}.mime.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages RENAME ${id}.xml)
install(FILES ${made}/${id}.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
install(FILES ${packaging}/${id}.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES ${packaging}/copyright ${made}/changelog.gz ${PROJECT_SOURCE_DIR}/CHANGELOG.md
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/hooke)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS ffmpeg)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Hooke authors <hooke@hooke.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "laboratory for networks of point masses and springs")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Add points, attach springs, nail, drag and release them while they move;
load ropes and cloths; choose among twelve integration methods, and
render pictures without a display. Hooke reports its own error, and the
cost of a smaller one.")
include(CPack)
