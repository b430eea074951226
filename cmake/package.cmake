# Desktop integration files and the Debian packages: cpack --config build/release/CPackConfig.cmake.

find_program(GZIP gzip REQUIRED)
set(id org.hooke.Hooke)
set(packaging ${PROJECT_SOURCE_DIR}/packaging)
set(made ${PROJECT_BINARY_DIR}/package)
include(cmake/releases.cmake)
configure_file(${packaging}/${id}.metainfo.xml.in ${made}/${id}.metainfo.xml @ONLY)
file(CONFIGURE OUTPUT ${made}/changelog CONTENT "${debian_changelog}\n" @ONLY)

execute_process(COMMAND ${GZIP} -9nkf ${made}/changelog COMMAND_ERROR_IS_FATAL ANY)

if(NOT HOOKE_LIBRARY_ONLY)
# Compressed without timestamps, so that the same sources give the same package.
add_custom_command(
  OUTPUT ${made}/hooke.1.gz
  COMMAND make_manual man > ${made}/hooke.1
  COMMAND ${GZIP} -9nf ${made}/hooke.1
  DEPENDS make_manual
  VERBATIM
)
set(completions)
foreach(shell IN ITEMS bash zsh fish)
  set(part ${packaging}/completion/hooke.${shell})
  add_custom_command(
    OUTPUT ${made}/hooke.${shell}
    COMMAND cat ${part} > ${made}/hooke.${shell}
    COMMAND make_manual completion | awk -f ${part}.awk >> ${made}/hooke.${shell}
    DEPENDS make_manual ${part} ${part}.awk
    VERBATIM
  )
  list(APPEND completions ${made}/hooke.${shell})
endforeach()
add_custom_target(package_files ALL DEPENDS ${made}/hooke.1.gz ${completions})

install(FILES ${made}/hooke.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${made}/hooke.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 RENAME hooke-headless.1.gz)
install(FILES ${made}/hooke.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME hooke)
install(FILES ${made}/hooke.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME hooke-headless)
install(FILES ${made}/hooke.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions RENAME _hooke)
install(FILES ${made}/hooke.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(FILES ${made}/hooke.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d RENAME hooke-headless.fish)
install(FILES ${packaging}/${id}.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES ${packaging}/${id}.mime.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages RENAME ${id}.xml)
install(FILES ${made}/${id}.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
install(FILES ${packaging}/${id}.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES ${packaging}/copyright ${made}/changelog.gz ${PROJECT_SOURCE_DIR}/CHANGELOG.md
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/hooke)
endif()

# Files of libhooke-dev: the package for find_package(hooke), and the one for pkg-config.
include(CMakePackageConfigHelpers)
set(cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/hooke)
configure_package_config_file(${packaging}/hooke-config.cmake.in ${made}/hooke-config.cmake INSTALL_DESTINATION ${cmake_folder})
write_basic_package_version_file(${made}/hooke-config-version.cmake COMPATIBILITY SameMajorVersion)
file(RELATIVE_PATH HOOKE_PREFIX_FROM_PKGCONFIG /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(${packaging}/hooke.pc.in ${made}/hooke.pc @ONLY)
install(EXPORT hooke-targets NAMESPACE hooke:: DESTINATION ${cmake_folder} COMPONENT development)
install(FILES ${made}/hooke-config.cmake ${made}/hooke-config-version.cmake DESTINATION ${cmake_folder} COMPONENT development)
install(FILES ${made}/hooke.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
foreach(pair library:libhooke1 development:libhooke-dev python:python3-hooke)
  string(REGEX MATCH "^([a-z]+):(.*)$" ignored ${pair})
  if(CMAKE_MATCH_1 STREQUAL python AND NOT hooke_python_found)
    continue()
  endif()
  install(FILES ${packaging}/copyright ${made}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CMAKE_MATCH_2}
          COMPONENT ${CMAKE_MATCH_1})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL library development)
if(NOT HOOKE_LIBRARY_ONLY)
  list(PREPEND CPACK_COMPONENTS_ALL hooke)
endif()
if(hooke_python_found)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEBIAN_HOOKE_PACKAGE_NAME hooke)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libhooke1)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libhooke-dev)
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-hooke)
# Which package provides the library, and that the cache of libraries is updated.
file(CONFIGURE OUTPUT ${made}/shlibs CONTENT "libhooke 1 libhooke1 (>= ${PROJECT_VERSION})\n")
file(CONFIGURE OUTPUT ${made}/triggers CONTENT "activate-noawait ldconfig\n")
install(FILES ${packaging}/libhooke1.lintian-overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides COMPONENT library RENAME libhooke1)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${made}/shlibs ${made}/triggers)
# Compiled files of Python, as dh_python3 makes and removes them.
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${made}/postinst ${made}/prerm)
foreach(script IN ITEMS postinst prerm)
  configure_file(${packaging}/python3-hooke.${script} ${made}/${script} COPYONLY)
endforeach()
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_HOOKE_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_HOOKE_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_DEBIAN_HOOKE_PACKAGE_SUGGESTS "ffmpeg, lammps, openmpi-bin")
set(CPACK_DEBIAN_HOOKE_PACKAGE_SECTION science)
# the shipped scenes are in the package hooke
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS hooke)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libhooke1 (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "hooke (= ${PROJECT_VERSION}), python3 (>= 3.11~), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS python3-matplotlib)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-tqdm, python3-scipy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Hooke authors <hooke@hooke.example>")
# The first line of each description is its summary, so there is no common one.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(CPACK_COMPONENT_HOOKE_DESCRIPTION "laboratory for networks of point masses and springs
Add points, attach springs, nail, drag and release them while they move;
load ropes and cloths; choose among twelve integration methods, and
render pictures without a display. Hooke reports its own error, and the
cost of a smaller one.")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "networks of point masses and springs, as a library\nThe modules of Hooke behind one stable interface for C++: load or build\na scene, step it, read it, and ask how wrong it is.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "networks of point masses and springs, development files\nThe header hooke/hooke.h, and the files for find_package(hooke) and\npkg-config.")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "networks of point masses and springs, for Python\nThe laboratory of Hooke as a Python module with NumPy arrays: scenes,\nruns, the error of a run, benchmarks, and pictures without a display.")
include(CPack)
