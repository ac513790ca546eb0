# Builds for WebAssembly with Debian's emscripten: one thread, exceptions of the engine itself. Its vectors serve the searches in text that are
# written for SSE2; arithmetic stays as it is written, so that results have the same bits as elsewhere.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
add_compile_options(-fwasm-exceptions -msimd128 -msse2 -fno-vectorize -fno-slp-vectorize)
add_link_options(-fwasm-exceptions)
