# SPDX-License-Identifier: Apache-2.0
# Installs BUILD into an empty prefix, then configures, builds and runs consumer/ against it with the
# C++ program that stands in README.
set(folder ${BUILD}/tests/install)
set(prefix ${folder}/prefix)
file(REMOVE_RECURSE ${prefix} ${folder}/consumer)

file(READ ${README} text)
string(REGEX MATCH "\n```cpp\n([^`]+)```" found "${text}")
if(NOT found)
  message(FATAL_ERROR "${README}: no C++ program")
endif()
file(WRITE ${folder}/readme.cpp "${CMAKE_MATCH_1}")

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed)
  if(failed)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed: ${command}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${folder}/consumer -G ${GENERATOR}
    -D CMAKE_CXX_COMPILER=${CXX} -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_BUILD_TYPE=Release
    -D PROGRAM=${folder}/readme.cpp)
run(${CMAKE_COMMAND} --build ${folder}/consumer)
run(${folder}/consumer/some_floors)
run(${folder}/consumer/all_floors)
