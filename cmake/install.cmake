# cmake --install: the command, the libraries with their headers, and what find_package(ringlet) and pkg-config read.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ringlet)

set(parts core)
if(RINGLET_BUILD_IO)
  list(APPEND parts io)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/ringletConfig.cmake.in ${PROJECT_BINARY_DIR}/ringletConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ringletConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ringletConfig.cmake ${PROJECT_BINARY_DIR}/ringletConfigVersion.cmake
  DESTINATION ${package_dir})

# pkg-config has a file a part, which finds the rest from where it lies.
file(RELATIVE_PATH pkgconfig_to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
# Who links a static library also links what that one needs; a program in C, what every C++ program has.
set(cxx_libraries ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(FILTER cxx_libraries INCLUDE REGEX "^(stdc\\+\\+|c\\+\\+)$")
if(NOT BUILD_SHARED_LIBS)  # A project in C alone has CMake link by the C compiler.
  target_link_libraries(ringlet_core INTERFACE $<LINK_ONLY:$<INSTALL_INTERFACE:$<$<LINK_LANGUAGE:C>:${cxx_libraries};m>>>)
endif()
list(TRANSFORM cxx_libraries PREPEND "-l")
list(JOIN cxx_libraries " " cxx_libraries)
set(core_requires)
set(core_needs fmt)
set(io_requires ringlet-core)
set(io_needs fmt libpng zlib libzstd)
set(core_summary "Simulates curly hair on Vulkan devices")
set(io_summary "Reads and writes what Ringlet simulates")
foreach(part ${parts})
  set(requires ${${part}_requires})
  set(requires_private)
  set(libs_private)
  if(NOT BUILD_SHARED_LIBS)
    list(JOIN ${part}_needs " " requires_private)
    set(libs_private "${cxx_libraries} -lm -ldl -pthread")
  endif()
  set(summary "${${part}_summary}")
  configure_file(${CMAKE_CURRENT_LIST_DIR}/ringlet.pc.in ${PROJECT_BINARY_DIR}/ringlet-${part}.pc @ONLY)
  add_subdirectory(${CMAKE_CURRENT_LIST_DIR}/install_part ${PROJECT_BINARY_DIR}/install_${part})
endforeach()
