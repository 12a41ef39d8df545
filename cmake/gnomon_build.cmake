# How our own code is compiled: standard, warnings, floating point, sanitizers. Nothing here reaches a user of the library.

if(GNOMON_TOP_LEVEL)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
  endif()
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
  find_program(GNOMON_CCACHE ccache)
  if(GNOMON_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${GNOMON_CCACHE}")
  endif()
endif()

set(GNOMON_WARNINGS -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Wswitch-enum)
# Contraction and fast-math change results; the library promises the same ones from every compiler.
set(GNOMON_FLOAT_FLAGS -ffp-contract=off -fno-fast-math)

set(GNOMON_OWN_FLAGS ${GNOMON_WARNINGS} ${GNOMON_FLOAT_FLAGS})
if(GNOMON_WERROR)
  list(APPEND GNOMON_OWN_FLAGS -Werror)
endif()

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  list(APPEND GNOMON_OWN_FLAGS -Wno-restrict) # false for "text" + std::string: GCC bug 105651
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND GNOMON_OWN_FLAGS -Wno-psabi) # a note on wide lanes as arguments; none crosses to objects of another target
endif()

if(CMAKE_CXX_FLAGS MATCHES "GLM_FORCE_SIZE_T_LENGTH")
  list(APPEND GNOMON_OWN_FLAGS -Wno-sign-conversion)
endif()

set(GNOMON_INSTRUMENT_FLAGS "")
if(GNOMON_SANITIZE)
  string(REPLACE ";" "," _sanitizers "${GNOMON_SANITIZE}")
  list(APPEND GNOMON_INSTRUMENT_FLAGS -fsanitize=${_sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND GNOMON_OWN_FLAGS -Wno-maybe-uninitialized) # a false one comes out of libstdc++ when instrumented
  endif()
endif()
if(GNOMON_COVERAGE)
  list(APPEND GNOMON_INSTRUMENT_FLAGS --coverage -fprofile-update=atomic)
endif()

# gnomon_own_flags(TARGET): the flags of this project's own translation units.
function(gnomon_own_flags target)
  set_target_properties(${target} PROPERTIES CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE ${GNOMON_OWN_FLAGS} ${GNOMON_INSTRUMENT_FLAGS})
  target_link_options(${target} PRIVATE ${GNOMON_INSTRUMENT_FLAGS})
  if(GNOMON_SCALAR)
    target_compile_definitions(${target} PRIVATE GNOMON_SCALAR=1)
  endif()
endfunction()
