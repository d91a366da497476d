# SPDX-License-Identifier: Apache-2.0
# OpenCV's modules one by one: find_package(OpenCV COMPONENTS core imgproc) makes the targets
# opencv_core and opencv_imgproc. OpenCV's own package file is not used, because on Debian it comes
# only with every module there is, and those bring several hundred packages.
find_path(OpenCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
mark_as_advanced(OpenCV_INCLUDE_DIR)

foreach(module IN LISTS OpenCV_FIND_COMPONENTS)
  find_library(OpenCV_${module}_LIBRARY opencv_${module})
  mark_as_advanced(OpenCV_${module}_LIBRARY)
  if(OpenCV_${module}_LIBRARY AND OpenCV_INCLUDE_DIR)
    set(OpenCV_${module}_FOUND TRUE)
  endif()
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCV REQUIRED_VARS OpenCV_INCLUDE_DIR HANDLE_COMPONENTS)
set(OpenCV_INCLUDE_DIRS ${OpenCV_INCLUDE_DIR})
set(OpenCV_LIBS)

foreach(module IN LISTS OpenCV_FIND_COMPONENTS)
  if(OpenCV_${module}_FOUND AND NOT TARGET opencv_${module})
    add_library(opencv_${module} UNKNOWN IMPORTED)
    set_target_properties(opencv_${module} PROPERTIES
                          IMPORTED_LOCATION ${OpenCV_${module}_LIBRARY}
                          INTERFACE_INCLUDE_DIRECTORIES ${OpenCV_INCLUDE_DIR})
  endif()
  list(APPEND OpenCV_LIBS opencv_${module})
endforeach()
