# SPDX-License-Identifier: Apache-2.0
# Answers find_package for WebAssembly, for which Debian builds no libraries: from the headers that it installs in
# /usr/include, and from the source packages that `./dev site` unpacks in MICROSWARM_SOURCES.
set(MICROSWARM_SOURCES ${CMAKE_SOURCE_DIR}/build/sources CACHE PATH "Unpacked source packages")

# Links to the headers alone: /usr/include itself has those of this machine's C library.
set(headers ${CMAKE_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${headers})
foreach(name boost fmt hwy nlohmann polyclipping yaml-cpp)
  file(CREATE_LINK /usr/include/${name} ${headers}/${name} SYMBOLIC)
endforeach()
include_directories(SYSTEM ${headers})
# Random123 asks for a machine that it knows, and its plain C is the same on all.
file(MAKE_DIRECTORY ${headers}/Random123)
file(CONFIGURE OUTPUT ${headers}/Random123/philox.h CONTENT
     "#define __riscv\n#include \"/usr/include/Random123/philox.h\"\n#undef __riscv\n")
set(MICROSWARM_RANDOM123_DIR ${headers} CACHE PATH "Random123")

macro(site_package method name)
  set(${name}_FOUND TRUE)
  if("${name}" STREQUAL fmt AND NOT TARGET fmt::fmt)
    add_library(fmt::fmt INTERFACE IMPORTED GLOBAL)
    target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
  elseif("${name}" STREQUAL nlohmann_json AND NOT TARGET nlohmann_json::nlohmann_json)
    add_library(nlohmann_json::nlohmann_json INTERFACE IMPORTED GLOBAL)
  elseif("${name}" STREQUAL hwy AND NOT TARGET hwy::hwy)
    add_library(hwy::hwy INTERFACE IMPORTED GLOBAL)
    # Its WebAssembly has no lanes of 64-bit floats.
    target_compile_definitions(hwy::hwy INTERFACE HWY_COMPILE_ONLY_EMU128)
  elseif("${name}" STREQUAL HDF5 AND NOT TARGET hdf5::hdf5)
    include(${CMAKE_SOURCE_DIR}/cmake/site/hdf5.cmake)
  elseif("${name}" STREQUAL yaml-cpp AND NOT TARGET yaml-cpp)
    file(GLOB sources ${MICROSWARM_SOURCES}/yaml-cpp/src/*.cpp)
    list(FILTER sources EXCLUDE REGEX "/parse.cpp$")  # opens files by streams, which libc++ lacks
    add_library(yaml-cpp STATIC ${sources})
  endif()
endmacro()
cmake_language(SET_DEPENDENCY_PROVIDER site_package SUPPORTED_METHODS FIND_PACKAGE)

# pkg_check_modules(NAME … IMPORTED_TARGET GLOBAL …)
function(pkg_check_modules name)
  if(TARGET PkgConfig::${name})
    return()
  endif()
  if(name STREQUAL polyclipping)
    add_library(polyclipping STATIC ${MICROSWARM_SOURCES}/libpolyclipping/cpp/clipper.cpp)
    target_include_directories(polyclipping PUBLIC ${headers}/polyclipping)
    add_library(PkgConfig::polyclipping ALIAS polyclipping)
  elseif(name STREQUAL SLEEF)
    set(plain ${CMAKE_SOURCE_DIR}/src/microswarm/core/maths)
    add_library(plain_sleef STATIC ${plain}/plain_sleef.cpp)
    target_compile_features(plain_sleef PUBLIC cxx_std_20)
    target_compile_options(plain_sleef PRIVATE -ffp-contract=off)
    target_include_directories(plain_sleef PRIVATE ${CMAKE_SOURCE_DIR}/src INTERFACE ${CMAKE_SOURCE_DIR}/cmake/site)
    add_library(PkgConfig::SLEEF ALIAS plain_sleef)
  endif()
endfunction()
