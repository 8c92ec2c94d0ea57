# cmake -DBUILD=... -P run.cmake: packs the built tree, reads what the packages depend on, and runs the unpacked program.
# Nothing outside BUILD/package_test is touched.
set(work ${BUILD}/package_test)
file(REMOVE_RECURSE ${work})

function(run output)
    execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE text ERROR_VARIABLE text RESULT_VARIABLE failed)
    if(failed)
        message(FATAL_ERROR "${ARGN}\n${text}")
    endif()
    set(${output} "${text}" PARENT_SCOPE)
endfunction()

get_filename_component(folder ${CMAKE_COMMAND} DIRECTORY)
run(output ${folder}/cpack --config ${BUILD}/CPackConfig.cmake -B ${work})
file(GLOB program ${work}/dermis_*.deb)
file(GLOB library ${work}/libdermis-dev_*.deb)

# Two that are opened at run time and two that are linked.
run(depends dpkg-deb -f ${program} Depends)
foreach(name mesa-vulkan-drivers fonts-dejavu-core libembree[34] libglfw3)
    if(NOT depends MATCHES "(^|, )${name}")
        message(FATAL_ERROR "dermis does not depend on ${name}: ${depends}")
    endif()
endforeach()
# The CMake package of libjpeg-turbo looks for a file of libjpeg62-turbo-dev.
run(depends dpkg-deb -f ${library} Depends)
foreach(name libopenexr-dev libturbojpeg0-dev libjpeg62-turbo-dev)
    if(NOT depends MATCHES "(^|, )${name}")
        message(FATAL_ERROR "libdermis-dev does not depend on ${name}: ${depends}")
    endif()
endforeach()

# A scene that only the unpacked tree has: the program takes its scenes from beside itself.
run(output dpkg-deb -x ${program} ${work}/root)
set(scenes ${work}/root/usr/share/dermis/scenes)
file(COPY_FILE ${scenes}/spheres.toml ${scenes}/only_here.toml)
run(output ${work}/root/usr/bin/dermis report)
if(NOT output MATCHES "scenes: [^\n]* only_here ")
    message(FATAL_ERROR "the unpacked program does not find its own scenes:\n${output}")
endif()
