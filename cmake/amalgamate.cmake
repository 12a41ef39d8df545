# One header of a module and all it needs of Gnomon, each file once:
#   cmake -DNAME=math -DROOT=. -DVERSION=0.1.0 -DOUT=gnomon_math.hpp -P cmake/amalgamate.cmake
# Every part keeps a guard of its own, so that several single headers can be used in one program.

cmake_minimum_required(VERSION 3.24)

set(parts "")
set(placed "")

# place(HEADER): appends the header to `parts`, with what it includes of Gnomon in the place of the #include.
function(place header)
  string(MAKE_C_IDENTIFIER "GNOMON_SINGLE_${header}" guard)
  string(REGEX MATCH "^gnomon/([a-z_]+)" _ "${header}")
  set(file "${ROOT}/modules/${CMAKE_MATCH_1}/include/${header}")
  file(READ "${file}" rest)
  string(REPLACE "#pragma once\n" "" rest "${rest}")
  string(APPEND parts "#ifndef ${guard}\n#define ${guard}\n// ---- ${header}\n")
  list(APPEND placed "${header}")
  string(PREPEND rest "\n")
  string(FIND "${rest}" "\n#include <gnomon/" at)
  while(NOT at EQUAL -1)
    string(SUBSTRING "${rest}" 0 ${at} before)
    math(EXPR at "${at} + 11") # behind "\n#include <"
    string(SUBSTRING "${rest}" ${at} -1 rest)
    string(FIND "${rest}" ">" end)
    string(SUBSTRING "${rest}" 0 ${end} next)
    math(EXPR end "${end} + 1")
    string(SUBSTRING "${rest}" ${end} -1 rest)
    string(APPEND parts "${before}\n")
    if(NOT next IN_LIST placed)
      place("${next}")
    endif()
    string(FIND "${rest}" "\n#include <gnomon/" at)
  endwhile()
  string(APPEND parts "${rest}#endif // ${guard}\n")
  set(parts "${parts}" PARENT_SCOPE)
  set(placed "${placed}" PARENT_SCOPE)
endfunction()

set(entry "gnomon/${NAME}.hpp")
if(NOT EXISTS "${ROOT}/modules/${NAME}/include/${entry}")
  set(entry "gnomon/${NAME}/${NAME}.hpp")
endif()
place("${entry}")
file(READ "${ROOT}/LICENSE" license)
string(REGEX REPLACE "\n+$" "" license "${license}")
string(REPLACE "\n" "\n// " license "${license}")
string(REPLACE "// \n" "//\n" license "${license}")
file(WRITE "${OUT}" "// Gnomon ${VERSION}: the module ${NAME} as one header, generated from its sources; do not edit.\n//\n// ${license}\n\n#pragma once\n${parts}")
