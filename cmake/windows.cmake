# Builds for 64-bit Windows on Linux, with Debian's g++-mingw-w64-x86-64-posix.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_AR x86_64-w64-mingw32-gcc-ar-posix)
set(CMAKE_RANLIB x86_64-w64-mingw32-gcc-ranlib-posix)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE NEVER)
# The version from which consoles show escape sequences and files can be replaced while they are read.
add_compile_definitions(_WIN32_WINNT=0x0A00 UNICODE _UNICODE NOMINMAX WIN32_LEAN_AND_MEAN)
# The same bytes each time: no time in the header of a program.
add_link_options(-static -Wl,--no-insert-timestamp)
# Debian's `wine` script also asks for a 32-bit Wine.
find_program(ISOCNC_WINE NAMES wine64 wine PATHS /usr/lib/wine)
find_program(ISOCNC_WINE_SERVER NAMES wineserver PATHS /usr/lib/wine)
if(ISOCNC_WINE AND ISOCNC_WINE_SERVER)
  set(wine env WINEDEBUG=-all WINEPREFIX=${CMAKE_BINARY_DIR}/wine)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${wine} ${ISOCNC_WINE})
  # Runs before the tests. Else the first program starts a server, which keeps that one's output open for seconds after its end. The
  # server makes no folder, and fails where one runs already; whether Wine runs is seen by the command.
  set(ISOCNC_START_EMULATOR ${wine} sh -c "mkdir -p $WINEPREFIX && (${ISOCNC_WINE_SERVER} -p60 || true) && ${ISOCNC_WINE} cmd /c exit")
endif()
