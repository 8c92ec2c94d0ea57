# What `cmake --install` puts in place: the command line, the CPU libraries with their public headers
# (include/dermis/<folder>/<header>.h), and a package: find_package(dermis CONFIG) gives dermis::bake and the rest.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(installed GLOBAL PROPERTY DERMIS_INSTALLED)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dermis)
foreach(folder ${installed})
    install(TARGETS dermis_${folder} EXPORT dermis ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    # Headers in subfolders are a library's own.
    file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/dermis/${folder}/*.h)
    install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dermis/${folder})
endforeach()
install(EXPORT dermis NAMESPACE dermis:: FILE dermis-targets.cmake DESTINATION ${package_dir})
install(TARGETS dermis RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/dermis-config.cmake.in
    ${PROJECT_BINARY_DIR}/dermis-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/dermis-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/dermis-config.cmake ${PROJECT_BINARY_DIR}/dermis-config-version.cmake
    DESTINATION ${package_dir})
