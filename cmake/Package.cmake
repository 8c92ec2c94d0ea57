# The Debian packages: `cmake --build build --target deb` leaves them in build/packages. Needs dpkg-dev and file.
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "The Dermis authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME dermis)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION graphics)
# Libraries that are linked are found by dpkg-shlibdeps; these are opened at run time.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "libvulkan1, mesa-vulkan-drivers | vulkan-icd, fonts-dejavu-core")
# Fetching the head; films of turntables; shaders of one's own.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "curl, ffmpeg, glslc")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libdermis-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Static libraries, headers and CMake package of Dermis, to bake tables, maps and shaders")
# What dermis-config.cmake looks for, and what the libraries are linked with: static libraries name none of it.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libopenexr-dev, libpng-dev, libturbojpeg0-dev, libjpeg62-turbo-dev | libjpeg-turbo8-dev, \
libembree-dev, libfreetype-dev, libosd-dev, libpugixml-dev")
include(CPack)

# The installed libraries are all linked into the program.
add_custom_target(deb COMMAND ${CMAKE_CPACK_COMMAND} DEPENDS dermis VERBATIM
    COMMENT "Debian packages in ${CPACK_PACKAGE_DIRECTORY}")
