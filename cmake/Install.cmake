# What `cmake --install` puts in place, in two components that `cpack` makes a Debian package of each:
#   runtime      dermis: the command line with the window and all shaders, the scenes, get_head
#   development  libdermis-dev: the CPU libraries, the headers that their PUBLIC_HEADERS name, and a CMake package:
#                find_package(dermis CONFIG) gives dermis::bake and the rest
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Tests and benchmarks need not be built to install or pack.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)

set(data_dir ${CMAKE_INSTALL_DATADIR}/dermis)
if(NOT DERMIS_LIBRARIES_ONLY)
    install(TARGETS dermis RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes DESTINATION ${data_dir} COMPONENT runtime FILES_MATCHING PATTERN *.toml)
    install(PROGRAMS ${PROJECT_SOURCE_DIR}/tools/get_head DESTINATION ${data_dir} COMPONENT runtime)
    install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/dermis RENAME copyright
        COMPONENT runtime)
endif()

get_property(installed GLOBAL PROPERTY DERMIS_INSTALLED)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dermis)
foreach(folder ${installed})
    install(TARGETS dermis_${folder} EXPORT dermis ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
    get_property(headers GLOBAL PROPERTY DERMIS_HEADERS_OF_${folder})
    list(TRANSFORM headers PREPEND ${PROJECT_SOURCE_DIR}/dermis/${folder}/)
    install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dermis/${folder} COMPONENT development)
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/dermis/dermis.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dermis COMPONENT development)
install(EXPORT dermis NAMESPACE dermis:: FILE dermis-targets.cmake DESTINATION ${package_dir} COMPONENT development)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/dermis-config.cmake.in
    ${PROJECT_BINARY_DIR}/dermis-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/dermis-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/dermis-config.cmake ${PROJECT_BINARY_DIR}/dermis-config-version.cmake
    DESTINATION ${package_dir} COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libdermis-dev RENAME copyright
    COMPONENT development)
if(NOT DERMIS_LIBRARIES_ONLY)
    include(${CMAKE_CURRENT_LIST_DIR}/Package.cmake)
endif()
