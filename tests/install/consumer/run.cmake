# cmake -DBUILD=... -DSOURCE=... -DGENERATOR=... -DMAKE_PROGRAM=... -DCOMPILER=... -DTABLE=... [-DLINK_FLAGS=...]
# [-DTOOLCHAIN=... -DEMULATOR=...] [-DLIBRARIES_ONLY=ON] -P run.cmake: installs the built tree beside it, builds the consumer
# against that, runs it. Nothing outside BUILD/consumer is touched. The generator, its program and the compiler are those of
# the build: others may not be there. TABLE is the name of the table's file, in a format that is built in.
cmake_minimum_required(VERSION 3.25)
set(work ${BUILD}/consumer)
file(REMOVE_RECURSE ${work})
set(target -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${work}/prefix)
set(suffix "")
if(TOOLCHAIN)
    set(target -DCMAKE_TOOLCHAIN_FILE=${TOOLCHAIN} -DCMAKE_FIND_ROOT_PATH=${work}/prefix)
    set(suffix .exe)
endif()
if(LINK_FLAGS)  # empty ones would replace those of the toolchain
    list(APPEND target -DCMAKE_EXE_LINKER_FLAGS=${LINK_FLAGS})
endif()
foreach(step
        "${CMAKE_COMMAND};--install;${BUILD};--prefix;${work}/prefix"
        "${CMAKE_COMMAND};-G;${GENERATOR};-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM};${target};-S;${SOURCE};-B;${work}/build;-DCMAKE_CXX_STANDARD=20"
        "${CMAKE_COMMAND};--build;${work}/build"
        "${EMULATOR};${work}/build/consumer${suffix};${SOURCE}/ball.obj;${work}/${TABLE};${work}/skin.hlsl")
    list(REMOVE_ITEM step "")
    execute_process(COMMAND ${step} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE failed)
    if(failed)
        message(FATAL_ERROR "${step}\n${output}")
    endif()
endforeach()
# D at the terminator of an 8 mm sphere, red: a number of the theory, not of this build.
if(NOT output MATCHES "curvature 0.125/mm: red at N.L 0 is 0.04[0-9]")
    message(FATAL_ERROR "the consumer printed '${output}'")
endif()
file(READ ${work}/skin.hlsl shader)
if(NOT shader MATCHES "float3 skin_diffuse\\(float n_dot_l, float curvature_per_mm\\)")
    message(FATAL_ERROR "the consumer's HLSL has no skin_diffuse()")
endif()
if(LIBRARIES_ONLY)
    return()
endif()
execute_process(COMMAND ${work}/build/thickness ${SOURCE}/ball.obj ${work}/thickness.png OUTPUT_VARIABLE output)
# A sphere of 8 mm reads 8 (1 + cos^2 45 degrees) = 12 mm (dermis/rays/bake_map.h); the icosahedron in it reads less.
if(NOT output MATCHES "thickness up to 1[01]" OR NOT EXISTS ${work}/thickness.png)
    message(FATAL_ERROR "the thickness program printed '${output}'")
endif()
execute_process(COMMAND ${work}/prefix/bin/dermis bake lut --size 8 -o ${work}/cli.csv RESULT_VARIABLE failed)
if(failed OR NOT EXISTS ${work}/cli.csv.json)
    message(FATAL_ERROR "the installed command line does not bake")
endif()
