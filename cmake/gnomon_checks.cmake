# What every public header must pass, beside the module's own tests:
#   - it compiles alone, and twice in one unit                        NAME_headers (an object per header, `detail` apart)
#   - all of all modules twice in one program                         header_units, run as test `house.two-units`
#   - floors 0-1, all in one unit each: without exceptions and RTTI, and under each GLM configuration macro that changes
#     types or conventions                                            header_matrix
#   - floors 0-1: Clang's front end, where the compiler is GCC and Clang 16 or later is installed
#   - a formula file is C++ and GLSL, alone: glslc reads it too, where it is installed, and its SPIR-V is kept in
#     BUILD/formulas for the test `house.formulas`; a .glsl beside the headers, in no folder `formula`, is for shaders alone
# Adapters are checked where what they need is installed.

set(GNOMON_GLM_MATRIX
  "GLM_FORCE_DEFAULT_ALIGNED_GENTYPES,GLM_FORCE_INTRINSICS"
  "GLM_FORCE_EXPLICIT_CTOR"
  "GLM_FORCE_XYZW_ONLY"
  "GLM_FORCE_SIZE_T_LENGTH"
  "GLM_FORCE_DEPTH_ZERO_TO_ONE,GLM_FORCE_LEFT_HANDED")

if(GNOMON_BUILD_TESTS AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT GNOMON_SANITIZE)
  find_program(GNOMON_CLANG NAMES clang++-19 clang++-18 clang++-17 clang++-16)
endif()

# _gnomon_unit(FILE DEFINES HEADERS...): writes a unit that includes the headers, twice each.
function(_gnomon_unit file defines)
  string(REPLACE "," ";" defines "${defines}")
  set(text "")
  foreach(define IN LISTS defines)
    string(APPEND text "#ifndef ${define}\n#define ${define}\n#endif\n")
  endforeach()
  foreach(header IN LISTS ARGN ARGN)
    string(APPEND text "#include <${header}>\n")
  endforeach()
  file(CONFIGURE OUTPUT "${file}" CONTENT "${text}" @ONLY)
endfunction()

# _gnomon_split_headers(): headers and adapters of the module; an adapter whose needs are missing is in neither.
macro(_gnomon_split_headers)
  file(GLOB_RECURSE headers RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}/include" CONFIGURE_DEPENDS include/*.hpp include/*.glsl)
  set(adapters "")
  set(adapter_modules "")
  set(adapter_packages "")
  foreach(entry IN LISTS m_ADAPTERS)
    string(REGEX REPLACE "=.*" "" header "${entry}")
    set(needs ${m_TEST_PACKAGES} ${m_PACKAGES_OPTIONAL})
    if(entry MATCHES "=(.*)")
      string(REPLACE "," ";" needs "${CMAKE_MATCH_1}")
    endif()
    list(REMOVE_ITEM headers "${header}")
    set(need_modules ${needs})
    get_property(declared GLOBAL PROPERTY GNOMON_DECLARED)
    list(REMOVE_ITEM needs ${declared})
    list(REMOVE_ITEM need_modules ${needs})
    _gnomon_missing(missing ${needs})
    if(NOT EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/include/${header}")
      message(STATUS "gnomon: ${header} is declared but does not exist") # an error of the test over the include graph
    elseif(missing)
      message(STATUS "gnomon: ${header} is not checked, for want of ${missing}")
    else()
      list(APPEND adapters "${header}")
      list(APPEND adapter_modules ${need_modules})
      list(APPEND adapter_packages ${needs})
    endif()
  endforeach()
endmacro()

# _gnomon_drop_shader_files(): leaves no .glsl in `headers` but formulas: `formula/*.glsl`, `formula.glsl`.
macro(_gnomon_drop_shader_files)
  set(shader_files ${headers})
  list(FILTER shader_files INCLUDE REGEX "\\.glsl$")
  list(FILTER shader_files EXCLUDE REGEX "/formula/|/formula\\.glsl$")
  list(REMOVE_ITEM headers ${shader_files})
endmacro()

macro(_gnomon_header_checks)
  _gnomon_split_headers()
  _gnomon_formula_checks()
  _gnomon_drop_shader_files()
  set(alone ${headers} ${adapters})
  list(FILTER alone EXCLUDE REGEX "/detail/")
  if(alone)
    set(folder "${CMAKE_CURRENT_BINARY_DIR}/header_checks")
    set(units "")
    foreach(header IN LISTS alone)
      string(MAKE_C_IDENTIFIER "${header}" id)
      _gnomon_unit("${folder}/${id}.cpp" "" "${header}")
      list(APPEND units "${folder}/${id}.cpp")
    endforeach()
    add_library(${name}_headers OBJECT ${units})
    _gnomon_link_tools(${name}_headers)
    gnomon_use(${name}_headers PRIVATE ${adapter_packages})
    foreach(module IN LISTS adapter_modules)
      target_link_libraries(${name}_headers PRIVATE gnomon::${module})
    endforeach()
    target_compile_options(${name}_headers PRIVATE -O0)
  endif()
  set_property(GLOBAL APPEND PROPERTY GNOMON_CHECKED_MODULES gnomon::${name})
  set_property(GLOBAL APPEND PROPERTY GNOMON_CHECKED_HEADERS ${headers})
  if(floor LESS 2)
    set_property(GLOBAL APPEND PROPERTY GNOMON_CHECKED_ONLY_HEADERS ${headers})
  endif()
endmacro()

# _gnomon_formula_shader(FILE FORMULA): writes a shader that includes nothing but the formula file, says what a texel
# and a word is (see math/README.md) and calls each of its functions, which glslc would leave out otherwise.
function(_gnomon_formula_shader file formula)
  set(source "${CMAKE_CURRENT_SOURCE_DIR}/include/${formula}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${source}")
  file(READ "${source}" text)
  string(REPLACE "[" "(" text "${text}") # no list takes brackets apart
  string(REPLACE "]" ")" text "${text}")
  string(REGEX MATCHALL "\nGN_[A-Z_]*FN [^{;]*{" heads "${text}")
  set(calls "")
  foreach(head IN LISTS heads)
    string(REGEX MATCH " (gn_[a-z0-9_]+)\\((.*)\\) {" _ "${head}")
    set(function "${CMAKE_MATCH_1}")
    string(REPLACE "," ";" parameters "${CMAKE_MATCH_2}")
    set(names "")
    foreach(parameter IN LISTS parameters)
      string(STRIP "${parameter}" parameter)
      string(REGEX MATCH "[a-z0-9_]+$" parameter_name "${parameter}")
      list(APPEND names "${parameter_name}")
    endforeach()
    string(JOIN " SEMICOLON " declared ${parameters})
    string(JOIN ", " names ${names})
    string(APPEND calls "    { ${declared} SEMICOLON ${function}(${names}) SEMICOLON }\n")
  endforeach()
  string(REPLACE " SEMICOLON" ";" calls "${calls}")
  file(CONFIGURE OUTPUT "${file}" @ONLY CONTENT "#version 450
#extension GL_GOOGLE_include_directive : require
#define GN_TEXELS int
#define GN_TEXEL(texels, x, y) float((texels) + (x) + (y))
#define GN_WORDS int
#define GN_WORD(words, i) (uint(words) + (i))
#include <${formula}>
void main() {
${calls}}
")
endfunction()

macro(_gnomon_formula_checks)
  set(formulas ${headers})
  list(FILTER formulas INCLUDE REGEX "\\.glsl$")
  gnomon_find(glslc)
  if(formulas AND NOT GNOMON_glslc_FOUND)
    message(STATUS "gnomon: the formulas of ${name} are not compiled as GLSL, for want of glslc")
  elseif(formulas)
    file(GLOB formula_includes "${PROJECT_SOURCE_DIR}/modules/*/include")
    list(TRANSFORM formula_includes PREPEND "-I")
    set(formula_spirv "")
    foreach(formula IN LISTS formulas)
      string(MAKE_C_IDENTIFIER "${formula}" id)
      set(base "${PROJECT_BINARY_DIR}/formulas/${id}")
      _gnomon_formula_shader("${base}.comp" "${formula}")
      file(READ "${CMAKE_CURRENT_SOURCE_DIR}/include/${formula}" formula_text)
      set(formula_stage compute)
      if(formula_text MATCHES "early_fragment_tests")
        set(formula_stage fragment)
      endif()
      add_custom_command(OUTPUT "${base}.spv"
        COMMAND "${GNOMON_glslc_PROGRAM}" -fshader-stage=${formula_stage} --target-env=vulkan1.3 -O0 -Werror ${formula_includes} -MD -MF "${base}.spv.d"
          -o "${base}.spv" "${base}.comp"
        DEPENDS "${base}.comp" DEPFILE "${base}.spv.d" COMMENT "${formula} as GLSL" VERBATIM)
      list(APPEND formula_spirv "${base}.spv")
    endforeach()
    add_custom_target(${name}_formulas ALL DEPENDS ${formula_spirv})
  endif()
endmacro()

# gnomon_joint_header_checks(): what is checked of all modules' headers at once. Called once, behind the modules.
function(gnomon_joint_header_checks)
  get_property(modules GLOBAL PROPERTY GNOMON_CHECKED_MODULES)
  get_property(headers GLOBAL PROPERTY GNOMON_CHECKED_HEADERS)
  get_property(header_only GLOBAL PROPERTY GNOMON_CHECKED_ONLY_HEADERS)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/header_checks")
  _gnomon_two_units()
  _gnomon_matrix_units()
  if(GNOMON_CLANG)
    _gnomon_clang_check()
  endif()
endfunction()

macro(_gnomon_matrix_units)
  set(units "")
  set(row 0)
  foreach(defines IN LISTS GNOMON_GLM_MATRIX)
    math(EXPR row "${row} + 1")
    _gnomon_unit("${folder}/glm_matrix_${row}.cpp" "${defines}" ${header_only})
    list(APPEND units "${folder}/glm_matrix_${row}.cpp")
    if(defines MATCHES "SIZE_T_LENGTH") # an int as an index is then a conversion, and no more than that
      set_source_files_properties("${folder}/glm_matrix_${row}.cpp" PROPERTIES COMPILE_OPTIONS -Wno-sign-conversion)
    endif()
  endforeach()
  _gnomon_unit("${folder}/no_exceptions.cpp" "" ${header_only})
  set_source_files_properties("${folder}/no_exceptions.cpp" PROPERTIES COMPILE_OPTIONS "-fno-exceptions;-fno-rtti")
  add_library(header_matrix OBJECT ${units} "${folder}/no_exceptions.cpp")
  gnomon_own_flags(header_matrix)
  target_compile_options(header_matrix PRIVATE -O0)
  target_link_libraries(header_matrix PRIVATE ${modules})
endmacro()

macro(_gnomon_two_units)
  _gnomon_unit("${folder}/unit_a.cpp" "" ${headers})
  _gnomon_unit("${folder}/unit_b.cpp" "" ${headers})
  file(CONFIGURE OUTPUT "${folder}/unit_main.cpp" CONTENT "int main() { return 0; }\n")
  add_executable(header_units "${folder}/unit_a.cpp" "${folder}/unit_b.cpp" "${folder}/unit_main.cpp")
  gnomon_own_flags(header_units)
  target_compile_options(header_units PRIVATE -O0)
  # Only what a user gets: no further packages.
  target_link_libraries(header_units PRIVATE ${modules})
  add_test(NAME house.two-units COMMAND header_units)
  set_tests_properties(house.two-units PROPERTIES LABELS "house")
endmacro()

macro(_gnomon_clang_check)
  _gnomon_unit("${folder}/unit_clang.cpp" "" ${header_only})
  file(GLOB_RECURSE all_headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/modules/*.hpp" "${PROJECT_SOURCE_DIR}/modules/*.glsl")
  set(includes "$<TARGET_PROPERTY:header_units,INCLUDE_DIRECTORIES>")
  set(include_flags "$<$<BOOL:${includes}>:-I$<JOIN:${includes},;-I>>")
  set(syntax "${GNOMON_CLANG}" -std=c++20 -fsyntax-only ${GNOMON_WARNINGS} ${GNOMON_FLOAT_FLAGS} -Werror)
  add_custom_command(OUTPUT "${folder}/clang.stamp"
    COMMAND ${syntax} "${include_flags}" "${folder}/unit_clang.cpp"
    COMMAND ${syntax} "${include_flags}" -fno-exceptions -fno-rtti "${folder}/unit_clang.cpp"
    COMMAND ${CMAKE_COMMAND} -E touch "${folder}/clang.stamp"
    DEPENDS ${all_headers} "${folder}/unit_clang.cpp"
    COMMENT "Clang reads the headers" COMMAND_EXPAND_LISTS VERBATIM)
  add_custom_target(header_clang ALL DEPENDS "${folder}/clang.stamp")
endmacro()
