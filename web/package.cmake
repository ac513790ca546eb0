# Makes the npm package in the folder OUT: cmake -D NPM=... -D NODE=... -D OUT=build/web -P web/package.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../cmake/npm_install.cmake)
npm_install(${CMAKE_CURRENT_LIST_DIR} ${NPM} status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "npm could not install what web/package-lock.json names")
endif()
execute_process(COMMAND ${NODE} build.mjs ${OUT} WORKING_DIRECTORY ${CMAKE_CURRENT_LIST_DIR} COMMAND_ERROR_IS_FATAL ANY)
