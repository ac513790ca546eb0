# The installed files, and the packages that `cpack` makes of them. The component `programs` is for all users. The
# component `development`, libraries and headers for find_package(isocnc), is packaged if ISOCNC_DEVELOPMENT is on;
# otherwise it is installed only by its name.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)
set(programs ${ISOCNC_PROGRAMS})
set(libraries fmt dialect text syntax geometry solids chords stock kinematics motion execution system git running threads timing simulation summary removal verification configuration tool_library restart comparison plot outline sheet
              command_line rules style fixes check selection fixing formats revisions formatting transforming translation input analyzer)
set(packaged ${CMAKE_BINARY_DIR}/packaged)

# Compresses as Debian requires: the same bytes each time.
find_program(ISOCNC_GZIP gzip)
function(install_compressed source name destination)
  if(ISOCNC_GZIP)
    set(folder ${packaged}/${destination})
    file(MAKE_DIRECTORY ${folder})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    execute_process(COMMAND ${ISOCNC_GZIP} -9nc ${source} OUTPUT_FILE ${folder}/${name}.gz COMMAND_ERROR_IS_FATAL ANY)
    install(FILES ${folder}/${name}.gz DESTINATION ${destination} COMPONENT programs)
  else()
    install(FILES ${source} DESTINATION ${destination} RENAME ${name} COMPONENT programs)
  endif()
endfunction()

# The manual pages, with the version in their first lines.
function(install_manual_page program folder)
  configure_file(${PROJECT_SOURCE_DIR}/docs/${folder}/${program}.1 ${packaged}/${folder}/${program}.1 @ONLY)
  string(REGEX REPLACE "^man" "" language ${folder})
  install_compressed(${packaged}/${folder}/${program}.1 ${program}.1 ${CMAKE_INSTALL_MANDIR}${language}/man1)
endfunction()

install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)

# What shells and `man` read, and the license and the two changelogs under the names that Debian requires. Windows has none of these.
function(install_for_posix)
  foreach(program IN LISTS programs)
    install_manual_page(${program} man)
    install_manual_page(${program} man/it)
    install(FILES scripts/completions/isocnc.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
            RENAME ${program} COMPONENT programs)
    install(FILES scripts/completions/isocnc.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
            RENAME ${program}.fish COMPONENT programs)
  endforeach()
  install(FILES scripts/completions/_isocnc DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT programs)
  install(FILES ${packaged}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)
  install_compressed(${packaged}/changelog.Debian changelog.Debian ${CMAKE_INSTALL_DOCDIR})
  install_compressed(${PROJECT_SOURCE_DIR}/CHANGELOG.md changelog ${CMAKE_INSTALL_DOCDIR})
  install(FILES cmake/lintian-overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME isocnc COMPONENT programs)
endfunction()

file(READ LICENSE license)
string(REGEX REPLACE "^[^\n]*\n\nCopyright \\(c\\) ([^\n]*)\n\n" "" license_text "${license}")
set(holders "${CMAKE_MATCH_1}")
string(STRIP "${license_text}" license_text)
string(REPLACE "\n" "\n " license_text " ${license_text}")
string(REPLACE "\n \n" "\n .\n" license_text "${license_text}")
configure_file(cmake/copyright.in ${packaged}/copyright @ONLY)
configure_file(cmake/changelog.Debian.in ${packaged}/changelog.Debian @ONLY)
if(WIN32)
  install(FILES LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)
  # The scripts find isolint.exe beside them.
  install(FILES cmake/windows/add-to-explorer.cmd cmake/windows/remove-from-explorer.cmd DESTINATION ${CMAKE_INSTALL_BINDIR}
          COMPONENT programs)
else()
  install_for_posix()
endif()
# What scripts/release writes there: the licenses of what the programs hold of others.
install(FILES ${packaged}/third-party-notices.txt DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs OPTIONAL)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)
install(DIRECTORY cmake/windows/notepad++ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs
        FILES_MATCHING PATTERN "*.md" PATTERN "*.json" PATTERN "*.svg" PATTERN "*.png" PATTERN man EXCLUDE)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)
# The post-processors of CAM systems, and the kit that proves any.
install(DIRECTORY posts DESTINATION ${CMAKE_INSTALL_DATADIR}/isocnc COMPONENT programs PATTERN __pycache__ EXCLUDE)

if(ISOCNC_DEVELOPMENT)
  set(unless_asked)
else()
  set(unless_asked EXCLUDE_FROM_ALL)
endif()
list(TRANSFORM libraries PREPEND isocnc_ OUTPUT_VARIABLE library_targets)
foreach(library IN LISTS libraries)
  set_target_properties(isocnc_${library} PROPERTIES EXPORT_NAME ${library})
  target_compile_features(isocnc_${library} INTERFACE cxx_std_20)
endforeach()
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/isocnc)
if(NOT ISOCNC_LARGE_UNITS)  # Else there is no library for each.
  install(TARGETS ${library_targets} EXPORT isocnc ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
          ${unless_asked} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/isocnc)
  install(EXPORT isocnc NAMESPACE isocnc:: FILE isocnc-targets.cmake DESTINATION ${package_dir} COMPONENT development
          ${unless_asked})
endif()
install(DIRECTORY interpreter analyzer DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/isocnc COMPONENT development ${unless_asked}
        FILES_MATCHING PATTERN "*.h")
install(FILES ${CMAKE_BINARY_DIR}/parts/dialect/diagnostic_names.inc ${CMAKE_BINARY_DIR}/parts/dialect/cause_names.inc
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/isocnc COMPONENT development ${unless_asked})
configure_package_config_file(cmake/isocnc-config.cmake.in ${packaged}/isocnc-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${packaged}/isocnc-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${packaged}/isocnc-config.cmake ${packaged}/isocnc-config-version.cmake DESTINATION ${package_dir}
        COMPONENT development ${unless_asked})

# The name of the platform, as of Node.js and of the packages for VS Code.
if(WIN32)
  set(platform windows-x64)
  set(CPACK_GENERATOR ZIP)
elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  set(platform linux-arm64)
  set(debian_architecture arm64)
  set(CPACK_GENERATOR DEB TGZ)
elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  set(platform linux-x64)
  set(debian_architecture amd64)
  set(CPACK_GENERATOR DEB TGZ)
else()
  set(platform ${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
  set(CPACK_GENERATOR TGZ)
endif()
set(CPACK_PACKAGE_FILE_NAME ${PROJECT_NAME}-${PROJECT_VERSION}-${platform})
set(CPACK_PACKAGE_CONTACT "${ISOCNC_MAINTAINER}")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS ${CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_DESCRIPTION
    "Tools for the G-code of a family of Italian five-axis routers: isolint tells
where the control would stop and why, isofmt writes programs as they should
be written, isorun runs them on a simulated machine and draws their path,
isodiff compares what two of them do there, isols and isodap are the language
server and the debugger of editors.")
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
if(debian_architecture)
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${debian_architecture})
  set(CPACK_DEBIAN_FILE_NAME ${PROJECT_NAME}_${PROJECT_VERSION}_${debian_architecture}.deb)
endif()
if(CMAKE_CROSSCOMPILING)
  # dpkg-shlibdeps would name the libraries of the cross compiler. The programs are linked statically but for this one.
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "libc6 (>= 2.36)")
else()
  list(TRANSFORM programs PREPEND ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/ OUTPUT_VARIABLE CPACK_ISOCNC_PROGRAMS)
  set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/debian_depends.cmake)
endif()
include(CPack)
