# The releases, from CHANGELOG.md, whose sections "## [1.0.0] - 2026-11-22" give their versions and dates: the entries of the metainfo and
# of the Debian changelog. The version itself is that of project() in CMakeLists.txt; it must have a section.

set(changelog ${PROJECT_SOURCE_DIR}/CHANGELOG.md)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${changelog})
file(STRINGS ${changelog} sections REGEX "^## \\[[0-9.]+\\] - [0-9-]+$")
set(metainfo_releases "")
set(debian_changelog "")
foreach(section IN LISTS sections)
  string(REGEX MATCH "\\[([0-9.]+)\\] - ([0-9-]+)" matched "${section}")
  set(version ${CMAKE_MATCH_1})
  set(date ${CMAKE_MATCH_2})
  if(NOT metainfo_releases AND NOT version STREQUAL PROJECT_VERSION)
    message(FATAL_ERROR "The first release in CHANGELOG.md is ${version}, but the version in CMakeLists.txt is ${PROJECT_VERSION}")
  endif()
  execute_process(COMMAND date --utc --rfc-email --date "${date} 12:00" OUTPUT_VARIABLE email_date OUTPUT_STRIP_TRAILING_WHITESPACE
                  COMMAND_ERROR_IS_FATAL ANY)
  string(APPEND metainfo_releases "    <release version=\"${version}\" date=\"${date}\"/>\n")
  string(APPEND debian_changelog "hooke (${version}) unstable; urgency=low\n\n  * Release ${version}: see CHANGELOG.md beside this file.\n\n"
                                 " -- The Hooke authors <hooke@hooke.example>  ${email_date}\n\n")
endforeach()
string(STRIP "${metainfo_releases}" metainfo_releases)
string(STRIP "${debian_changelog}" debian_changelog)
