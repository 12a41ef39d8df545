# Single headers: BUILD/single_include/gnomon_NAME.hpp for every module of floors 0-1 (target `gnomon_single_headers`).
# With GNOMON_TESTS_WITH_SINGLE_HEADERS the modules' tests see nothing else: each <gnomon/x/y.hpp> forwards to one.

set(GNOMON_SINGLE_DIR "${PROJECT_BINARY_DIR}/single_include")
set(GNOMON_FORWARD_DIR "${PROJECT_BINARY_DIR}/single_forward")

# gnomon_single_header(NAME): the rule that generates it, and the headers that forward to it.
function(_gnomon_single_header name adapters)
  set(folder "${PROJECT_SOURCE_DIR}/modules/${name}/include")
  file(GLOB_RECURSE headers RELATIVE "${folder}" CONFIGURE_DEPENDS "${folder}/*.hpp")
  foreach(header IN LISTS headers)
    set(text "#pragma once\n#include <gnomon_${name}.hpp>\n")
    # Without an umbrella the module's own header is the one; what else lies beside it comes alone, as adapters do.
    if(header IN_LIST adapters OR (NOT EXISTS "${folder}/gnomon/${name}.hpp" AND NOT header STREQUAL "gnomon/${name}/${name}.hpp"))
      set(text "#pragma once\n#include \"${folder}/${header}\"\n")
    endif()
    file(CONFIGURE OUTPUT "${GNOMON_FORWARD_DIR}/${header}" CONTENT "${text}" @ONLY)
  endforeach()
  file(GLOB_RECURSE all CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/modules/*.hpp" "${PROJECT_SOURCE_DIR}/modules/*.glsl")
  set(out "${GNOMON_SINGLE_DIR}/gnomon_${name}.hpp")
  add_custom_command(OUTPUT "${out}"
    COMMAND ${CMAKE_COMMAND} -DNAME=${name} "-DROOT=${PROJECT_SOURCE_DIR}" -DVERSION=${PROJECT_VERSION} "-DOUT=${out}"
      -P "${PROJECT_SOURCE_DIR}/cmake/amalgamate.cmake"
    DEPENDS ${all} "${PROJECT_SOURCE_DIR}/cmake/amalgamate.cmake" "${PROJECT_SOURCE_DIR}/LICENSE"
    COMMENT "One header of ${name}" VERBATIM)
  set_property(GLOBAL APPEND PROPERTY GNOMON_SINGLE_HEADERS "${out}")
endfunction()

# gnomon_single_headers(): called once, behind the modules.
function(gnomon_single_headers)
  set(names "")
  foreach(name IN LISTS GNOMON_MADE)
    gnomon_floor(${name} floor)
    if(floor LESS 2)
      get_property(adapters GLOBAL PROPERTY GNOMON_${name}_ADAPTERS)
      list(TRANSFORM adapters REPLACE "=.*" "")
      _gnomon_single_header(${name} "${adapters}")
      list(APPEND names ${name})
    endif()
  endforeach()
  get_property(headers GLOBAL PROPERTY GNOMON_SINGLE_HEADERS)
  add_custom_target(gnomon_single_headers DEPENDS ${headers})
  set(GNOMON_SINGLE_NAMES "${names}" PARENT_SCOPE)
endfunction()

# gnomon_use_single_headers(TARGET): the target includes single headers, whatever it links.
function(gnomon_use_single_headers target)
  target_include_directories(${target} BEFORE PRIVATE "${GNOMON_FORWARD_DIR}" "${GNOMON_SINGLE_DIR}")
  add_dependencies(${target} gnomon_single_headers)
endfunction()
