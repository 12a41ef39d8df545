# Copies the headers of some modules into a folder and compiles a program with them, by the bare compiler.
#   cmake -DCXX=... -DSOURCE=... -DFOLDER=... -DFLAGS=... -P copied.cmake
file(REMOVE_RECURSE "${FOLDER}")
foreach(name core math)
  file(COPY "${SOURCE}/modules/${name}/include/" DESTINATION "${FOLDER}/include")
endforeach()
separate_arguments(flags UNIX_COMMAND "${FLAGS}")
execute_process(COMMAND_ERROR_IS_FATAL ANY
  COMMAND "${CXX}" -std=c++20 ${flags} "-I${FOLDER}/include" "${SOURCE}/tests/consumers/project/main.cpp" -o "${FOLDER}/program")
execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND "${FOLDER}/program")
