# npm_install(folder npm result [OPTION...]): installs what the folder's package-lock.json names, where npm has not done so yet. All builds share what
# it installs. `result` is 0 where all is there.
function(npm_install folder npm result)
  file(LOCK ${folder} DIRECTORY)
  set(installed ${folder}/node_modules/.package-lock.json)
  set(status 0)
  if(NOT EXISTS ${installed} OR ${folder}/package-lock.json IS_NEWER_THAN ${installed})
    execute_process(
      COMMAND ${npm} ci ${ARGN} --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1
              --fetch-retry-mintimeout=1000
      WORKING_DIRECTORY ${folder} RESULT_VARIABLE status OUTPUT_QUIET)
  endif()
  set(${result} ${status} PARENT_SCOPE)
endfunction()
