# Language level, warnings, sanitizers and compiler cache: everything that applies to all targets.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

set(SINEW_SANITIZE "" CACHE STRING "Sanitizers to build with, for example address,undefined")

add_library(sinew_options INTERFACE)
target_compile_options(sinew_options INTERFACE -Wall -Wextra)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # Both warn of the standard library's own strings at -O3 (GCC bugs 105651 and 105562).
  target_compile_options(sinew_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict>
                                                 $<$<COMPILE_LANGUAGE:CXX>:-Wno-maybe-uninitialized>)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
  # std::stable_sort of GCC 12's library calls what that library itself calls deprecated. GCC goes on
  # reporting our own uses of anything deprecated.
  target_compile_options(sinew_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-deprecated-declarations>)
endif()
if(SINEW_SANITIZE)
  target_compile_options(sinew_options INTERFACE -fsanitize=${SINEW_SANITIZE} -fno-omit-frame-pointer
                                                 -fno-sanitize-recover=all)
  target_link_options(sinew_options INTERFACE -fsanitize=${SINEW_SANITIZE})
endif()

find_program(SINEW_CCACHE ccache)
if(SINEW_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER ${SINEW_CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${SINEW_CCACHE})
endif()
