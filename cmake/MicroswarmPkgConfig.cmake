# SPDX-License-Identifier: Apache-2.0
# Files for pkg-config: microswarm.pc is everything that was built, microswarm-planning.pc and the like are one floor
# with those it stands on. They are found from any prefix. Everything is linked statically, so all that is needed is in
# Libs and Requires. Included by MicroswarmInstall.cmake.
set(pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH pkgconfig_prefix /${pkgconfig_dir} /)
string(REGEX REPLACE "/$" "" pkgconfig_prefix ${pkgconfig_prefix})

# What a target is called by pkg-config; without a file for pkg-config, by the linker.
set(pkgconfig_of_fmt::fmt fmt)
set(pkgconfig_of_hwy::hwy libhwy)
set(pkgconfig_of_yaml-cpp yaml-cpp)
set(pkgconfig_of_pugixml::pugixml pugixml)
set(pkgconfig_of_TIFF::TIFF libtiff-4)
set(pkgconfig_of_Eigen3::Eigen eigen3)
set(flags_of_GIF::GIF -lgif)
set(flags_of_SQLiteCpp "-lSQLiteCpp -lsqlite3")
set(flags_of_Threads::Threads -pthread)
set(headers_only nlohmann_json::nlohmann_json Boost::headers)

# microswarm_pkgconfig(NAME TEXT REQUIRES LIBS CFLAGS): writes and installs NAME.pc.
function(microswarm_pkgconfig name text requires libs cflags)
  string(JOIN ", " requires ${requires})
  string(JOIN " " libs ${libs})
  file(WRITE ${PROJECT_BINARY_DIR}/pkgconfig/${name}.pc
"prefix=\${pcfiledir}/${pkgconfig_prefix}
includedir=\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}
libdir=\${prefix}/${CMAKE_INSTALL_LIBDIR}

Name: ${name}
Description: ${text}
Version: ${PROJECT_VERSION}
Requires: ${requires}
Cflags: -I\${includedir}${cflags}
Libs: -L\${libdir} ${libs}
")
  install(FILES ${PROJECT_BINARY_DIR}/pkgconfig/${name}.pc DESTINATION ${pkgconfig_dir} COMPONENT development)
endfunction()

set(pkgconfig_floors)
foreach(name IN LISTS floor_names)
  get_target_property(links microswarm_${name} LINK_LIBRARIES)
  set(requires)
  set(libs -lmicroswarm_${name})
  set(cflags)
  if(name STREQUAL core)  # what is loaded at the first use
    list(APPEND libs -Wl,-rpath,\${libdir}/microswarm ${CMAKE_DL_LIBS})
    list(TRANSFORM libs REPLACE "^dl$" "-ldl")
  endif()
  foreach(link IN LISTS links)
    if(link MATCHES "^microswarm::(.+)")
      list(APPEND requires microswarm-${CMAKE_MATCH_1})
    elseif(link MATCHES "^PkgConfig::(.+)")
      string(TOLOWER ${CMAKE_MATCH_1} found)
      list(APPEND requires ${found})
    elseif(pkgconfig_of_${link})
      list(APPEND requires ${pkgconfig_of_${link}})
    elseif(flags_of_${link})
      list(APPEND libs ${flags_of_${link}})
    elseif(link MATCHES "^opencv_")
      list(APPEND libs -l${link})
      set(cflags " -I${OpenCV_INCLUDE_DIR}")
    elseif(link MATCHES "^/.*/lib([^/]+)\\.(so|a)$")
      list(APPEND libs -l${CMAKE_MATCH_1})
    elseif(NOT link IN_LIST headers_only AND NOT link MATCHES "^\\$<BUILD_INTERFACE|^(${CMAKE_DL_LIBS})$")
      message(FATAL_ERROR "cmake/MicroswarmPkgConfig.cmake: how does pkg-config call '${link}' of ${name}?")
    endif()
  endforeach()
  list(REMOVE_DUPLICATES requires)
  microswarm_pkgconfig(microswarm-${name} "${PROJECT_DESCRIPTION} (floor ${name})" "${requires}" "${libs}" "${cflags}")
  list(APPEND pkgconfig_floors microswarm-${name})
endforeach()
list(REVERSE pkgconfig_floors)
microswarm_pkgconfig(microswarm "${PROJECT_DESCRIPTION}" "${pkgconfig_floors}" "" "")
