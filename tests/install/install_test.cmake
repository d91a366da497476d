# SPDX-License-Identifier: Apache-2.0
# Installs BUILD into an empty prefix, then configures, builds and runs consumer/ against it with the C++ program that
# stands in README and one that keeps a record; the same by pkg-config. Then the programs and projects of pages of SOURCE.
set(folder ${BUILD}/tests/install)
set(prefix ${folder}/prefix)
file(REMOVE_RECURSE ${prefix} ${folder}/consumer ${folder}/work)
file(MAKE_DIRECTORY ${folder}/work)

include(${SOURCE}/cmake/page_block.cmake)
page_block(${SOURCE}/README.md cpp 1 readme)
file(WRITE ${folder}/readme.cpp "${readme}")

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
    -D README=${folder}/readme.cpp -D RECORDED=${SOURCE}/examples/02_run.cpp)
fails("no component 'plannign'.*there are: core, geometry" ${configure} -D MISTYPED=plannign)
file(REMOVE_RECURSE ${folder}/consumer)
run(${configure})
run(${CMAKE_COMMAND} --build ${folder}/consumer)
run(${folder}/consumer/some_floors)
run(${folder}/consumer/all_floors)

# The module that writes records is found in the prefix, where neither the program nor the system looks by itself.
run(${folder}/consumer/recorded ${flight})
if(NOT EXISTS ${folder}/work/02_run.h5)
  message(FATAL_ERROR "no record was kept")
endif()
# Without the run path, the variable names its folder.
run(${CMAKE_COMMAND} -E copy ${folder}/consumer/recorded ${folder}/work/moved)
file(RPATH_REMOVE FILE ${folder}/work/moved)
run(${CMAKE_COMMAND} -E env MICROSWARM_MODULES=${prefix}/lib/microswarm ${folder}/work/moved ${flight})

# A program in a loop of its own: the page's files, and its commands line by line.
set(page ${SOURCE}/docs/how-to/embed-in-cpp.md)
set(own ${folder}/own)
file(REMOVE_RECURSE ${own})
page_block(${page} cpp 1 program)
file(WRITE ${own}/embedded/embedded.cpp "${program}")
file(WRITE ${folder}/embedded.cpp "${program}")
page_block(${page} cmake 1 project)
file(WRITE ${own}/embedded/CMakeLists.txt "${project}")
find_program(PKG_CONFIG pkg-config)
set(commands "cmake|build/")
if(PKG_CONFIG)
  string(APPEND commands "|export|c[+][+]")
endif()
file(STRINGS ${page} lines REGEX "^    (${commands})")
list(LENGTH lines count)
if(count LESS 3)
  message(FATAL_ERROR "${page}: no commands")
endif()
list(JOIN lines "\n" lines)
string(REGEX REPLACE "([ =])PREFIX" "\\1${prefix}" lines "${lines}")
file(CREATE_LINK ${CXX} ${own}/c++ SYMBOLIC)
run(${CMAKE_COMMAND} -E chdir ${own}/embedded ${CMAKE_COMMAND} -E env PATH=${own}:$ENV{PATH} CXX=${CXX} CMAKE_GENERATOR=${GENERATOR}
    sh -exc "${lines}")
if(PKG_CONFIG)
  run(${own}/embedded/embedded ${flight})
endif()

# Projects of pages, for the program of README.
page_block(${SOURCE}/docs/how-to/install.md cmake 1 installed)
page_block(${SOURCE}/docs/explanation/architecture.md cmake 1 floors)
set(floors "cmake_minimum_required(VERSION 3.25)\nproject(mine LANGUAGES CXX)\nadd_executable(mine mine.cpp)\n${floors}")
foreach(project IN ITEMS installed floors)
  file(WRITE ${own}/${project}/CMakeLists.txt "${${project}}")
  file(WRITE ${own}/${project}/mine.cpp "${readme}")
  run(${CMAKE_COMMAND} -S ${own}/${project} -B ${own}/${project}/build -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${CXX}
      -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_BUILD_TYPE=Release)
  run(${CMAKE_COMMAND} --build ${own}/${project}/build)
  run(${own}/${project}/build/mine)
endforeach()

if(PKG_CONFIG)
  file(GLOB_RECURSE file ${prefix}/microswarm-experiment.pc)
  get_filename_component(pkgconfig ${file} DIRECTORY)
  foreach(program IN ITEMS "readme microswarm-planning" "embedded microswarm")
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
