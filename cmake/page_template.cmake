# Writes the page of isorun --plot FILE.html as C++ source, if one of its inputs has changed:
#
#   cmake -D VIEW=toolpath-view -D OUT=page_template.cpp -D NPM=... -D NODE=... -D REQUIRED=ON|OFF -P page_template.cmake
#
# If npm is missing or gets no answer, the page is empty and a warning is printed; with REQUIRED that is an error.

set(empty_page "#include \"interpreter/plot/page_template.h\"

namespace isocnc::plot {

const std::string_view kPageTemplate;

}  // namespace isocnc::plot
")

function(write_if_different text)
  set(old)
  if(EXISTS ${OUT})
    file(READ ${OUT} old)
  endif()
  if(NOT old STREQUAL text)
    file(WRITE ${OUT} "${text}")
  endif()
endfunction()

# Writes an empty page; the next build tries again.
function(do_without why)
  if(REQUIRED)
    message(FATAL_ERROR "isorun --plot FILE.html: ${why}")
  endif()
  message(WARNING "isorun is built without --plot FILE.html: ${why}")
  write_if_different("${empty_page}")
  file(REMOVE ${OUT}.made-of)
endfunction()

if(NOT NPM OR NOT NODE)
  write_if_different("${empty_page}")
  return()
endif()

file(GLOB sources ${VIEW}/src/* ${VIEW}/build.mjs ${VIEW}/page_file.mjs ${VIEW}/package-lock.json)
set(digests)
foreach(source IN LISTS sources)
  file(SHA256 ${source} digest)
  list(APPEND digests ${digest})
endforeach()
if(EXISTS ${OUT} AND EXISTS ${OUT}.made-of)
  file(READ ${OUT}.made-of made_of)
  if(made_of STREQUAL digests)
    return()
  endif()
endif()

include(${CMAKE_CURRENT_LIST_DIR}/npm_install.cmake)
npm_install(${VIEW} ${NPM} status --omit=dev)
if(NOT status EQUAL 0)
  do_without("npm could not install what toolpath-view/package-lock.json names")
  return()
endif()
execute_process(COMMAND ${NODE} build.mjs ${OUT}.new WORKING_DIRECTORY ${VIEW} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "toolpath-view could not be built")
endif()
file(COPY_FILE ${OUT}.new ${OUT} ONLY_IF_DIFFERENT)
file(REMOVE ${OUT}.new)
file(WRITE ${OUT}.made-of "${digests}")
