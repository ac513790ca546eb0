# The libraries of others that we use. A cross build takes their headers from the packages of the machine that builds,
# whose own folder of headers the other system must not see.

# isocnc_headers(fmt fmt/format.h ...): the imported target fmt::fmt gets the folder of that header, alone.
function(isocnc_headers target header)
  find_path(folder ${header} PATHS /usr/include /usr/local/include /usr/include/eigen3 NO_DEFAULT_PATH
            NO_CMAKE_FIND_ROOT_PATH NO_CACHE REQUIRED)
  get_filename_component(part ${header} DIRECTORY)
  while(part MATCHES "/")
    get_filename_component(part ${part} DIRECTORY)
  endwhile()
  set(alone ${CMAKE_BINARY_DIR}/headers/${part})
  file(MAKE_DIRECTORY ${alone})
  file(CREATE_LINK ${folder}/${part} ${alone}/${part} SYMBOLIC)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${alone})
  target_compile_definitions(${target} INTERFACE ${ARGN})
endfunction()

if(CMAKE_CROSSCOMPILING)
  isocnc_headers(Eigen3::Eigen Eigen/Core)
  isocnc_headers(fmt::fmt fmt/format.h)
  isocnc_headers(nlohmann_json::nlohmann_json nlohmann/json.hpp)
  isocnc_headers(FastFloat::fast_float fast_float/fast_float.h)
  isocnc_headers(CLI11::CLI11 CLI/CLI.hpp)
else()
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  find_package(fmt 9 REQUIRED)
  find_package(nlohmann_json 3.11 REQUIRED)
  find_package(FastFloat 3.9 REQUIRED)
  find_package(CLI11 2.1 REQUIRED)
endif()
# Headers alone, without a package of CMake.
isocnc_headers(isocnc_stb stb/stb_image.h)
find_package(Threads REQUIRED)

# fmt as a part of the programs, or the library of the system.
if(ISOCNC_STATIC)
  add_library(isocnc_fmt STATIC cmake/fmt.cpp)
  target_include_directories(isocnc_fmt SYSTEM PUBLIC $<TARGET_PROPERTY:fmt::fmt,INTERFACE_INCLUDE_DIRECTORIES>)
else()
  add_library(isocnc_fmt INTERFACE)
  target_link_libraries(isocnc_fmt INTERFACE fmt::fmt)
endif()
add_library(isocnc::fmt ALIAS isocnc_fmt)
