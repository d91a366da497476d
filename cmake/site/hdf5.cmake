# SPDX-License-Identifier: Apache-2.0
# hdf5::hdf5 for WebAssembly, from Debian's sources of HDF5 and zlib. Its settings are those of Debian's package, without
# what WASI lacks and with the sizes of wasm32; its own H5detect, run by node, writes the types of the machine.
find_program(MICROSWARM_NODE node REQUIRED)
set(made ${CMAKE_BINARY_DIR}/hdf5)
set(source ${MICROSWARM_SOURCES}/hdf5/src)

file(READ /usr/include/hdf5/serial/H5pubconf.h settings)
foreach(lacked ALARM ARPA_INET_H ASPRINTF CURL_CURL_H EMBEDDED_LIBINFO FCNTL FILTER_SZIP FLOAT128 FLOCK FORK GETHOSTNAME
        GETPWUID GETRUSAGE IOCTL LIBCRYPTO LIBCURL LIBPTHREAD LIBSZ LONGJMP NETDB_H NETINET_IN_H OPENSSL_EVP_H
        OPENSSL_HMAC_H OPENSSL_SHA_H PTHREAD_H PWD_H QUADMATH_H ROS3_VFD SETJMP SETJMP_H SIGLONGJMP SIGNAL SIGPROCMASK
        STAT_ST_BLOCKS SYMLINK SYS_FILE_H SYS_IOCTL_H SYS_RESOURCE_H SYS_SOCKET_H SYS_TIMEB_H SYSTEM SZLIB_H THREADSAFE
        TIMEZONE TIOCGETD TIOCGWINSZ TM_GMTOFF TMPFILE VASPRINTF WAITPID)
  string(REGEX REPLACE "#define H5_HAVE_${lacked} [^\n]*" "" settings "${settings}")
endforeach()
foreach(word LONG PTRDIFF_T SIZE_T SSIZE_T INT_FAST16_T INT_FAST32_T UINT_FAST16_T UINT_FAST32_T)
  string(REGEX REPLACE "#define H5_SIZEOF_${word} [^\n]*" "#define H5_SIZEOF_${word} 4" settings "${settings}")
endforeach()
string(REGEX REPLACE "#define H5_(USE_FILE_LOCKING|SYSTEM_SCOPE_THREADS|SIZEOF___FLOAT128) [^\n]*" "" settings "${settings}")
file(CONFIGURE OUTPUT ${made}/include/H5pubconf.h CONTENT "${settings}" @ONLY)
file(CONFIGURE OUTPUT ${made}/include/sys/wait.h CONTENT "")
file(CONFIGURE OUTPUT ${made}/include/pwd.h CONTENT "")
file(CONFIGURE OUTPUT ${made}/include/setjmp.h CONTENT  # H5detect probes with signals, of which there are none
     "typedef int jmp_buf[1], sigjmp_buf[1];\n#define setjmp(x) 0\n#define longjmp(x, y) (void)0\n")
file(CONFIGURE OUTPUT ${made}/include/dlfcn.h CONTENT "#define RTLD_LAZY 1\n#define RTLD_LOCAL 0
#define dlopen(file, how) ((void*)0)\n#define dlsym(of, name) ((void*)0)\n#define dlclose(of) 0\n#define dlerror() ((char*)0)\n")

add_library(hdf5_settings INTERFACE)
target_include_directories(hdf5_settings INTERFACE ${made}/include ${source})
target_compile_options(hdf5_settings INTERFACE -w -Wno-implicit-int -D_WASI_EMULATED_SIGNAL -D_WASI_EMULATED_GETPID -D_WASI_EMULATED_PROCESS_CLOCKS)

add_executable(H5detect EXCLUDE_FROM_ALL ${source}/H5detect.c)
target_link_libraries(H5detect PRIVATE hdf5_settings -lc-printscan-long-double -lwasi-emulated-signal -lwasi-emulated-getpid)
add_custom_command(OUTPUT ${made}/H5Tinit.c
  COMMAND ${MICROSWARM_NODE} --no-warnings ${CMAKE_SOURCE_DIR}/cmake/site/run.mjs $<TARGET_FILE:H5detect> ${made}/H5Tinit.c
  DEPENDS H5detect VERBATIM)

file(GLOB sources ${source}/*.c)
list(FILTER sources EXCLUDE REGEX "/(H5detect|H5make_libsettings|H5FDmpi|H5FDmpio|H5mpi).c$")
set(zlib ${MICROSWARM_SOURCES}/zlib)
file(CONFIGURE OUTPUT ${made}/lacking.c CONTENT "char H5libhdf5_settings[] = \"\";\nint tzset(void) { return 0; }\n")
list(APPEND sources ${made}/H5Tinit.c ${made}/lacking.c)
foreach(name adler32 compress crc32 deflate inffast inflate inftrees trees uncompr zutil)
  list(APPEND sources ${zlib}/${name}.c)
endforeach()
add_library(hdf5 STATIC EXCLUDE_FROM_ALL ${sources})
set_target_properties(hdf5 PROPERTIES UNITY_BUILD OFF)
set_source_files_properties(${source}/H5system.c PROPERTIES COMPILE_OPTIONS -Wno-implicit-function-declaration)  # tzset
target_include_directories(hdf5 PRIVATE ${zlib})
target_link_libraries(hdf5 PUBLIC hdf5_settings)
add_library(hdf5::hdf5 ALIAS hdf5)
