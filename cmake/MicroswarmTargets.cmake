# SPDX-License-Identifier: Apache-2.0
# Compiler settings shared by every target, and the functions that make one.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
find_program(MICROSWARM_CCACHE ccache)
if(MICROSWARM_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${MICROSWARM_CCACHE})
endif()

add_library(microswarm_options INTERFACE)
# The same bits in every build: no contraction to fused multiply-add, no fast math.
target_compile_options(microswarm_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                       -Wno-sign-conversion -Wno-missing-field-initializers -ffp-contract=off
                       -fno-semantic-interposition)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # gcc 12 sees an overlap that is not there wherever two strings are joined.
  target_compile_options(microswarm_options INTERFACE -Wno-restrict)
endif()
if(MICROSWARM_SANITIZE)
  target_compile_options(microswarm_options INTERFACE -fsanitize=${MICROSWARM_SANITIZE}
                         -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(microswarm_options INTERFACE -fsanitize=${MICROSWARM_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
    # What gcc says of itself. Warnings are for the release build to give.
    string(REGEX REPLACE ",.*" "" sanitizer "${MICROSWARM_SANITIZE}")
    string(TOUPPER ${sanitizer} sanitizer)
    target_compile_options(microswarm_options INTERFACE -w -D__SANITIZE_${sanitizer}__=1)
  endif()
endif()
if(MICROSWARM_SANITIZE_NOT)
  target_compile_options(microswarm_options INTERFACE -fno-sanitize=${MICROSWARM_SANITIZE_NOT})
endif()

# Code that calls what is fast: less optimised, compiled in two thirds of the time, and with a
# sanitizer in half of it.
set(microswarm_glue_options $<$<CONFIG:Release>:-O1> $<$<CONFIG:RelWithDebInfo>:-O0>)
# Code of the floors in which little time is spent: a sanitizer takes half of the time to compile it.
set(microswarm_calm_options $<$<CONFIG:RelWithDebInfo>:-O0>)
# Loops over pixels can be vectorised where no comparison may trap. The values are the same.
set(microswarm_pixel_options -fno-trapping-math)
if(MICROSWARM_FUZZ)
  target_compile_options(microswarm_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# microswarm_floor(NAME SOURCES ... FLOORS ... PUBLIC ... PRIVATE ...): the library of one floor.
function(microswarm_floor name)
  cmake_parse_arguments(arg "" "" "SOURCES;FLOORS;PUBLIC;PRIVATE" ${ARGN})
  set(target microswarm_${name})
  add_library(${target} STATIC ${arg_SOURCES})
  add_library(microswarm::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                             $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
                             $<INSTALL_INTERFACE:include>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  list(TRANSFORM arg_FLOORS PREPEND microswarm::)
  target_link_libraries(${target} PUBLIC ${arg_FLOORS} ${arg_PUBLIC}
                        PRIVATE $<BUILD_INTERFACE:microswarm_options> ${arg_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY MICROSWARM_FLOORS ${target})
endfunction()

# microswarm_module(FLOOR NAME SOURCES ... LIBRARIES ...): what `load_module(NAME)` loads for a floor at the first use,
# from bin/../lib/microswarm. It says which version it is of, because it and its user share classes.
function(microswarm_module floor name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  include(GNUInstallDirs)
  set(target microswarm_${name})
  set(version ${CMAKE_CURRENT_BINARY_DIR}/${target}_version.c)
  file(CONFIGURE OUTPUT ${version} @ONLY
       CONTENT "const char microswarm_@name@_version[] = \"@PROJECT_VERSION@\";\n")
  add_library(${target} MODULE ${arg_SOURCES} ${version})
  set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/microswarm
                        CXX_VISIBILITY_PRESET default)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_BINARY_DIR}/generated)
  target_link_libraries(${target} PRIVATE microswarm_options ${arg_LIBRARIES})
  if(NOT MICROSWARM_SANITIZE)  # its functions are in the program
    target_link_options(${target} PRIVATE LINKER:-z,defs)
  endif()
  install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/microswarm COMPONENT program)
  add_dependencies(microswarm_${floor} ${target})
endfunction()
