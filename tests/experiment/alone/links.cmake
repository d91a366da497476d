# SPDX-License-Identifier: Apache-2.0
# cmake -D PROGRAM=… -P links.cmake: fails if PROGRAM is linked with what only rigs, records and
# front ends need.
execute_process(COMMAND ldd ${PROGRAM} OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
foreach(unwanted opencv hdf5 usb aravis v4l gstreamer glib sqlite cairo mpi)
  if(libraries MATCHES "lib${unwanted}[^ ]*")
    message(SEND_ERROR "${PROGRAM} is linked with ${CMAKE_MATCH_0}")
  endif()
endforeach()
execute_process(COMMAND nm -C ${PROGRAM} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
foreach(unwanted "boost::asio" "cv::" "H5F" "microswarm::actuation::CoilDriver"
        "microswarm::vision::FrameSource")
  if(symbols MATCHES "[^\n]* ${unwanted}[^\n]*")
    message(SEND_ERROR "${PROGRAM} contains ${CMAKE_MATCH_0}")
  endif()
endforeach()
