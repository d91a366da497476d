# SPDX-License-Identifier: Apache-2.0
# Debian packages of what is installed: `./dev package`, or `cpack --config build/release/CPackConfig.cmake`.
# A package is a component of install(). One more is its name in CPACK_COMPONENTS_ALL and a call of debian_package.
include(GNUInstallDirs)
set(document_dir ${CMAKE_INSTALL_DATAROOTDIR}/doc)

if(MICROSWARM_APPS)
  # The manual, from what the program says. Sanitizers would make it slow.
  find_package(Python3 COMPONENTS Interpreter)
  if(Python3_Interpreter_FOUND AND NOT MICROSWARM_SANITIZE)
    set(manual ${PROJECT_BINARY_DIR}/man)
    add_custom_command(
      OUTPUT ${manual}/microswarm.1
      COMMAND Python3::Interpreter -B ${PROJECT_SOURCE_DIR}/tools/man_pages.py $<TARGET_FILE:microswarm> ${manual}
      DEPENDS microswarm ${PROJECT_SOURCE_DIR}/tools/man_pages.py ${PROJECT_SOURCE_DIR}/tools/reference.py
      COMMENT "Writing the manual" VERBATIM)
    add_custom_target(microswarm_manual ALL DEPENDS ${manual}/microswarm.1)
    install(DIRECTORY ${manual}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program OPTIONAL)
  endif()
  install(FILES ${PROJECT_SOURCE_DIR}/apps/completion/microswarm.bash RENAME microswarm
          DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions COMPONENT program)
  install(FILES ${PROJECT_SOURCE_DIR}/apps/completion/_microswarm
          DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/zsh/vendor-completions COMPONENT program)
endif()

if(NOT MICROSWARM_APPS OR NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()

# Builds all that is packed.
add_custom_target(microswarm_packaged)
add_dependencies(microswarm_packaged microswarm ${floors})
foreach(target microswarm_manual microswarm_c microswarm_python)
  if(TARGET ${target})
    add_dependencies(microswarm_packaged ${target})
  endif()
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program development)
if(TARGET microswarm_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_SOURCE_DIR}/build/packages)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGE_CONTACT "microswarm contributors <microswarm@localhost>")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# debian_package(COMPONENT NAME SUMMARY TEXT DEPENDS): the Debian package of a component, with its licence. What its programs
# and libraries are linked with is added to DEPENDS.
function(debian_package component name summary text depends)
  string(TOUPPER ${component} key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${summary}\n${text}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE RENAME copyright DESTINATION ${document_dir}/${name} COMPONENT ${component})
  install(FILES ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${document_dir}/${name} COMPONENT ${component})
endfunction()

debian_package(program microswarm
        "planning, steering and measuring magnetic microrobot swarms"
        "The program microswarm runs experiments in simulation, on a simulated rig or on a real one, shows them in a
browser, records, replays and compares them. With scenarios, firmware, manual and completion for bash and zsh."
        "gnuplot-nox | gnuplot, fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "gcc-avr, avr-libc, make, avrdude")  # microswarm rig flash

# What find_package(microswarm) looks for, by the names of Debian; the modules that the libraries load are in microswarm.
set(debian_fmt libfmt-dev)
set(debian_nlohmann_json nlohmann-json3-dev)
set(debian_yaml-cpp libyaml-cpp-dev)
set(debian_hwy libhwy-dev)
set(debian_SLEEF libsleef-dev)
set(debian_polyclipping libpolyclipping-dev)
set(debian_GIF libgif-dev)
set(debian_TIFF libtiff-dev)
set(debian_pugixml libpugixml-dev)
set(debian_LIBEXIF libexif-dev)
set(debian_SPNG libspng-dev)
set(debian_LIBTURBOJPEG libturbojpeg0-dev)
set(debian_Eigen3 libeigen3-dev)
set(debian_Boost libboost-dev)
set(debian_SQLiteCpp libsqlitecpp-dev)
set(debian_CAIRO libcairo2-dev)
set(debian_Threads libc6-dev)
set(development_depends "microswarm (= ${PROJECT_VERSION})" pkg-config)
if(TARGET microswarm_learning)
  list(APPEND development_depends libdlib-dev)  # linked by its path
endif()
foreach(found IN LISTS foreign_packages)
  if(found MATCHES "^OpenCV COMPONENTS (.+)")
    list(APPEND development_depends libopencv-${CMAKE_MATCH_1}-dev)
    continue()
  endif()
  string(REGEX REPLACE "^PkgConfig::| COMPONENTS .*" "" found ${found})
  if(NOT debian_${found})
    message(FATAL_ERROR "cmake/MicroswarmPackage.cmake: no Debian package is named for '${found}'")
  endif()
  list(APPEND development_depends ${debian_${found}})
endforeach()
list(REMOVE_DUPLICATES development_depends)
list(JOIN development_depends ", " development_depends)

debian_package(development libmicroswarm-dev
        "planning, steering and measuring magnetic microrobot swarms (library)"
        "Static libraries, headers, the CMake package, the C library and the package for MATLAB and Octave of microswarm: planners,
navigators, swarm models, simulation, cameras, coils and records."
        "${development_depends}")

if(TARGET microswarm_python)
  find_package(Python 3.11 REQUIRED COMPONENTS Interpreter)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  debian_package(python python3-microswarm
          "planning, steering and measuring magnetic microrobot swarms (Python 3)"
          "The Python package microswarm: scenarios, runs, sessions, navigators, maps, paths and records as NumPy arrays."
          "microswarm (= ${PROJECT_VERSION}), python3-numpy, python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor})")
  # Compiles the .py files where they are installed, and removes what was compiled.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/bindings/python/debian/postinst
      ${PROJECT_SOURCE_DIR}/bindings/python/debian/prerm)
endif()
include(CPack)
