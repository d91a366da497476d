# SPDX-License-Identifier: Apache-2.0
# Installs the floors' libraries and headers, and the package that find_package(microswarm) reads.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/microswarm)
set(modules_dir ${CMAKE_INSTALL_LIBDIR}/microswarm)
get_property(floors GLOBAL PROPERTY MICROSWARM_FLOORS)
list(TRANSFORM floors REPLACE "^microswarm_" "" OUTPUT_VARIABLE floor_names)

# package_of(LINK RESULT): what find_package must be asked for so that the target LINK exists;
# empty for a target of ours or a path. A target's namespace is its package's name, as a rule; what
# pkg-config found is asked for by its target.
function(package_of link result)
  set(package)
  if(link MATCHES "^opencv_(.+)")
    set(package "OpenCV COMPONENTS ${CMAKE_MATCH_1}")
  elseif(link MATCHES "^(PkgConfig::.+|yaml-cpp|SQLiteCpp)$")
    set(package ${link})
  elseif(link MATCHES "^([^:]+)::" AND NOT CMAKE_MATCH_1 STREQUAL microswarm)
    set(package ${CMAKE_MATCH_1})
  endif()
  set(${result} ${package} PARENT_SCOPE)
endfunction()

# For the package file: the floors and the foreign packages that each floor links.
set(floor_needs)
set(foreign_packages)
foreach(name IN LISTS floor_names)
  get_target_property(links microswarm_${name} LINK_LIBRARIES)
  set(packages)
  foreach(link IN LISTS links)
    package_of(${link} package)
    list(APPEND packages ${package})
  endforeach()
  list(REMOVE_DUPLICATES packages)
  list(APPEND foreign_packages ${packages})
  list(FILTER links INCLUDE REGEX "^microswarm::")
  list(TRANSFORM links REPLACE "^microswarm::" "")
  string(APPEND floor_needs "set(microswarm_${name}_floors ${links})\n"
                            "set(microswarm_${name}_packages \"${packages}\")\n")
endforeach()

# microswarm::microswarm is everything that was built; a single floor brings those it stands on.
add_library(microswarm_all INTERFACE)
add_library(microswarm::microswarm ALIAS microswarm_all)
set_target_properties(microswarm_all PROPERTIES EXPORT_NAME microswarm)
target_link_libraries(microswarm_all INTERFACE ${floors})

install(TARGETS ${floors} microswarm_all EXPORT microswarmTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT microswarmTargets NAMESPACE microswarm:: DESTINATION ${package_dir}
        COMPONENT development)
foreach(name IN LISTS floor_names)
  install(DIRECTORY src/microswarm/${name} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/microswarm
          COMPONENT development FILES_MATCHING PATTERN "*.hpp"
          # These need headers of Aravis, HDF5 and Cairo, and serve sources only.
          PATTERN aravis.hpp EXCLUDE PATTERN library.hpp EXCLUDE PATTERN drawing_file.hpp EXCLUDE)
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/generated/microswarm/core/version.hpp
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/microswarm/core COMPONENT development)

configure_package_config_file(cmake/microswarmConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/microswarmConfig.cmake
                              INSTALL_DESTINATION ${package_dir} PATH_VARS modules_dir)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/microswarmConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/microswarmConfig.cmake
              ${PROJECT_BINARY_DIR}/microswarmConfigVersion.cmake
              cmake/FindOpenCV.cmake DESTINATION ${package_dir} COMPONENT development)
include(MicroswarmPkgConfig)
