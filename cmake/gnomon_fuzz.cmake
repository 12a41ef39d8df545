# Fuzz targets: a module's fuzz/X.fuzz.cpp (see gnomon/check/fuzz.hpp) becomes
#   - NAME_X_replay  in every build: runs the seeds and a fixed number of their mutations; test `NAME.fuzz-X`
#   - NAME_X_fuzz    with GNOMON_FUZZ (preset `asan-ubsan`): libFuzzer, with a short run from the seeds as test `NAME.libfuzzer-X`
#   - fuzzers        builds all of them
# A longer run, from a corpus that the replay program writes:
#   cmake --preset asan-ubsan && cmake --build --preset asan-ubsan --target fuzzers
#   mkdir -p corpus && build/asan-ubsan/bin/raster_pass_replay --write-corpus corpus
#   build/asan-ubsan/bin/raster_pass_fuzz -max_total_time=600 corpus
# A target may be given its own options by a list: set(GNOMON_FUZZ_OPTIONS_scene_load -rss_limit_mb=512) before gnomon_module.

if(GNOMON_FUZZ AND NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  message(FATAL_ERROR "gnomon: GNOMON_FUZZ needs Clang, which brings libFuzzer (Debian: clang-16 libclang-rt-16-dev)")
endif()

# A part of gnomon_module: reads its arguments.
macro(_gnomon_fuzz)
  file(GLOB fuzz_files CONFIGURE_DEPENDS fuzz/*.fuzz.cpp)
  _gnomon_missing(missing ${m_TEST_PACKAGES})
  if(fuzz_files AND NOT missing)
    foreach(file IN LISTS fuzz_files)
      get_filename_component(stem "${file}" NAME_WE)
      _gnomon_fuzz_replay()
      if(GNOMON_FUZZ)
        _gnomon_fuzz_libfuzzer()
      endif()
    endforeach()
  endif()
endmacro()

macro(_gnomon_fuzz_replay)
  set(replay ${name}_${stem}_replay)
  add_executable(${replay} "${file}")
  _gnomon_link_tools(${replay})
  target_link_libraries(${replay} PRIVATE gnomon::check)
  add_test(NAME ${name}.fuzz-${stem} COMMAND ${replay})
  set_tests_properties(${name}.fuzz-${stem} PROPERTIES TIMEOUT 300 LABELS "fuzz")
  if(NOT TARGET fuzzers)
    add_custom_target(fuzzers)
  endif()
  add_dependencies(fuzzers ${replay})
endmacro()

macro(_gnomon_fuzz_libfuzzer)
  set(fuzzer ${name}_${stem}_fuzz)
  set(corpus "${CMAKE_CURRENT_BINARY_DIR}/corpus_${stem}")
  file(MAKE_DIRECTORY "${corpus}")
  add_executable(${fuzzer} "${file}")
  _gnomon_link_tools(${fuzzer})
  target_link_libraries(${fuzzer} PRIVATE gnomon::check)
  target_compile_definitions(${fuzzer} PRIVATE GNOMON_FUZZ_LIBFUZZER=1)
  target_link_options(${fuzzer} PRIVATE -fsanitize=fuzzer)
  add_dependencies(fuzzers ${fuzzer})
  add_test(NAME ${name}.corpus-${stem} COMMAND ${replay} --write-corpus "${corpus}")
  add_test(NAME ${name}.libfuzzer-${stem}
    COMMAND ${fuzzer} -runs=3000 -max_total_time=60 -timeout=20 -seed=1 ${GNOMON_FUZZ_OPTIONS_${name}_${stem}} "${corpus}")
  set_tests_properties(${name}.corpus-${stem} PROPERTIES LABELS "fuzz" FIXTURES_SETUP ${name}_${stem}_corpus)
  set_tests_properties(${name}.libfuzzer-${stem} PROPERTIES TIMEOUT 300 LABELS "fuzz" FIXTURES_REQUIRED ${name}_${stem}_corpus)
endmacro()
