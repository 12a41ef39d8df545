# Shaders: GLSL becomes SPIR-V at build time and is embedded as numbers.
#
#   gnomon_shaders(TARGET NAMESPACE shaders/blur.comp ...)
#
# gives TARGET the private header "shaders/blur_comp.hpp" with `inline constexpr std::span<std::uint32_t const>
# NAMESPACE::blur_comp`. Shaders include the formula files of every module: #include <gnomon/shadow/formula/x.glsl>.
# Not optimized: spirv-opt turns a * b + c into Fma, one rounding for two, and drivers optimize anyway.
# SPIR-V 1.5: glslc's 1.6 says the group size as an id, for which a device needs maintenance4.
# Without glslc the span is empty, and a device that asks for it is told so.

function(gnomon_shaders target namespace)
  gnomon_find(glslc)
  file(GLOB includes "${PROJECT_SOURCE_DIR}/modules/*/include")
  list(TRANSFORM includes PREPEND "-I")
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/${target}_shaders")
  set(headers "")
  foreach(file IN LISTS ARGN)
    get_filename_component(file_name "${file}" NAME)
    string(MAKE_C_IDENTIFIER "${file_name}" name)
    set(header "${folder}/shaders/${name}.hpp")
    set(words "")
    if(GNOMON_glslc_FOUND)
      set(spirv "${folder}/${name}.inc")
      add_custom_command(OUTPUT "${spirv}"
        COMMAND "${GNOMON_glslc_PROGRAM}" --target-env=vulkan1.3 --target-spv=spv1.5 -O0 -Werror -mfmt=num ${includes} -MD -MF "${spirv}.d"
          -o "${spirv}" "${CMAKE_CURRENT_SOURCE_DIR}/${file}"
        DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${file}" DEPFILE "${spirv}.d" COMMENT "SPIR-V of ${file}" VERBATIM)
      list(APPEND headers "${spirv}")
      set(words "inline constexpr std::uint32_t ${name}_words[] = {\n#include \"${spirv}\"\n};\n")
    endif()
    set(value "")
    if(words)
      set(value "${name}_words")
    endif()
    file(CONFIGURE OUTPUT "${header}" @ONLY CONTENT
      "#pragma once\n// SPIR-V of ${file}, generated.\n\n#include <cstdint>\n#include <span>\n\nnamespace ${namespace} {\n${words}inline constexpr std::span<std::uint32_t const> ${name}{${value}};\n}\n")
    list(APPEND headers "${header}")
  endforeach()
  target_sources(${target} PRIVATE ${headers})
  target_include_directories(${target} PRIVATE "${folder}")
endfunction()
