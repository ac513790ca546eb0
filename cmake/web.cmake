# Builds for WebAssembly with Debian's emscripten: one thread, exceptions of the engine itself.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
add_compile_options(-fwasm-exceptions)
add_link_options(-fwasm-exceptions)
