# Install and export: `find_package(gnomon)` gives every module as gnomon::NAME, and finds again the packages found here.

include(CMakePackageConfigHelpers)

function(_gnomon_install_module name)
  if(NOT GNOMON_INSTALL)
    return()
  endif()
  set_target_properties(gnomon_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS gnomon_${name} EXPORT gnomonTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp" PATTERN "*.glsl")
endfunction()

# gnomon_install_package(): the config file, written for exactly the packages that installed modules link.
function(gnomon_install_package)
  if(NOT GNOMON_INSTALL OR NOT GNOMON_MADE)
    return()
  endif()
  set(linked "")
  foreach(name IN LISTS GNOMON_MADE)
    get_property(packages GLOBAL PROPERTY GNOMON_${name}_PACKAGES)
    list(APPEND linked ${packages})
  endforeach()
  list(REMOVE_DUPLICATES linked)
  set(GNOMON_FIND_DEPENDENCIES "")
  foreach(package IN LISTS linked)
    list(GET GNOMON_PACKAGE_${package} 0 cmake_name)
    if(NOT cmake_name MATCHES "^(HEADER|LIBRARY|PROGRAM)$") # used inside only
      string(APPEND GNOMON_FIND_DEPENDENCIES "find_dependency(${cmake_name})\n")
    endif()
  endforeach()
  set(folder "${CMAKE_INSTALL_LIBDIR}/cmake/gnomon")
  configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/gnomonConfig.cmake.in"
    "${CMAKE_CURRENT_BINARY_DIR}/gnomonConfig.cmake" INSTALL_DESTINATION "${folder}")
  write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/gnomonConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/gnomonConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/gnomonConfigVersion.cmake"
    DESTINATION "${folder}")
  install(EXPORT gnomonTargets NAMESPACE gnomon:: DESTINATION "${folder}")
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
endfunction()
