# What the Debian package takes, as dpkg-shlibdeps says of the programs. cpack reads this file before each package. CPACK_DEBIAN_PACKAGE_SHLIBDEPS
# would ask it the same, but look for programs among all files of the package first, by two processes for each.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
if(NOT DPKG_SHLIBDEPS)
  message(WARNING "The package does not say what it takes, since there is no dpkg-shlibdeps.")
  return()
endif()
# It takes a folder of a source package.
set(folder ${CPACK_PACKAGE_DIRECTORY}/_CPack_Packages/depends)
file(WRITE ${folder}/debian/control "")
execute_process(COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C ${DPKG_SHLIBDEPS} --ignore-missing-info -O ${CPACK_ISOCNC_PROGRAMS}
                WORKING_DIRECTORY ${folder} OUTPUT_VARIABLE depends ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
if(NOT depends MATCHES "^shlibs:Depends=([^\n]+)$")
  message(FATAL_ERROR "dpkg-shlibdeps names no libraries: ${depends}")
endif()
set(CPACK_DEBIAN_PACKAGE_DEPENDS "${CMAKE_MATCH_1}")
