# SPDX-License-Identifier: Apache-2.0
# Installs BUILD into an empty prefix, then configures, builds and runs consumer/ against it with the C++ programs that
# stand in README and in the page EMBED, and one that keeps a record; the same by pkg-config.
set(folder ${BUILD}/tests/install)
set(prefix ${folder}/prefix)
file(REMOVE_RECURSE ${prefix} ${folder}/consumer ${folder}/work)
file(MAKE_DIRECTORY ${folder}/work)

function(write_program page name)
  file(READ ${page} text)
  string(REGEX MATCH "\n```cpp\n([^`]+)```" found "${text}")
  if(NOT found)
    message(FATAL_ERROR "${page}: no C++ program")
  endif()
  file(WRITE ${folder}/${name} "${CMAKE_MATCH_1}")
endfunction()
write_program(${README} readme.cpp)
write_program(${EMBED} embedded.cpp)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed WORKING_DIRECTORY ${folder}/work)
  if(failed)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed: ${command}")
  endif()
endfunction()

# fails(WORDS COMMAND...): it fails and says WORDS.
function(fails words)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said
                  WORKING_DIRECTORY ${folder}/work)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  if(NOT failed OR NOT said MATCHES "${words}")
    message(FATAL_ERROR "not refused with '${words}': ${ARGN}: ${said}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
set(flight ${prefix}/share/microswarm/scenarios/first_flight.yaml)
set(configure ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${folder}/consumer -G ${GENERATOR}
    -D CMAKE_CXX_COMPILER=${CXX} -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_BUILD_TYPE=Release
    -D README=${folder}/readme.cpp -D EMBEDDED=${folder}/embedded.cpp -D RECORDED=${EXAMPLES}/02_run.cpp)
fails("no component 'plannign'.*there are: core, geometry" ${configure} -D MISTYPED=plannign)
file(REMOVE_RECURSE ${folder}/consumer)
run(${configure})
run(${CMAKE_COMMAND} --build ${folder}/consumer)
run(${folder}/consumer/some_floors)
run(${folder}/consumer/all_floors)
run(${folder}/consumer/embedded ${flight})

# The module that writes records is found in the prefix, where neither the program nor the system looks by itself.
run(${folder}/consumer/recorded ${flight})
if(NOT EXISTS ${folder}/work/02_run.h5)
  message(FATAL_ERROR "no record was kept")
endif()
# Without the run path, the variable names its folder.
run(${CMAKE_COMMAND} -E copy ${folder}/consumer/recorded ${folder}/work/moved)
file(RPATH_REMOVE FILE ${folder}/work/moved)
run(${CMAKE_COMMAND} -E env MICROSWARM_MODULES=${prefix}/lib/microswarm ${folder}/work/moved ${flight})

find_program(PKG_CONFIG pkg-config)
if(PKG_CONFIG)
  file(GLOB_RECURSE file ${prefix}/microswarm-experiment.pc)
  get_filename_component(pkgconfig ${file} DIRECTORY)
  foreach(program IN ITEMS "readme microswarm-planning" "embedded microswarm-experiment" "embedded microswarm")
    separate_arguments(program)
    list(POP_FRONT program name)
    execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${pkgconfig} ${PKG_CONFIG} --cflags --libs ${program}
                    OUTPUT_VARIABLE flags RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(failed)
      message(FATAL_ERROR "pkg-config does not know ${program}")
    endif()
    separate_arguments(flags UNIX_COMMAND "${flags}")
    run(${CXX} -std=c++20 ${folder}/${name}.cpp ${flags} -o ${folder}/work/${name})
    run(${folder}/work/${name} ${flight})
  endforeach()
endif()
