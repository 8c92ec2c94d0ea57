# cmake -DBUILD=... -DSOURCE=... -DGENERATOR=... -DMAKE_PROGRAM=... -DCOMPILER=... [-DLINK_FLAGS=...] -P run.cmake: installs the
# built tree beside it, builds the consumer against that, runs it. Nothing outside BUILD/consumer is touched. The generator,
# its program and the compiler are those of the build: others may not be there.
set(work ${BUILD}/consumer)
file(REMOVE_RECURSE ${work})
foreach(step
        "${CMAKE_COMMAND};--install;${BUILD};--prefix;${work}/prefix"
        "${CMAKE_COMMAND};-G;${GENERATOR};-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM};-DCMAKE_CXX_COMPILER=${COMPILER};-S;${SOURCE};-B;${work}/build;-DCMAKE_PREFIX_PATH=${work}/prefix;-DCMAKE_CXX_STANDARD=20;-DCMAKE_EXE_LINKER_FLAGS=${LINK_FLAGS}"
        "${CMAKE_COMMAND};--build;${work}/build"
        "${work}/build/consumer;${work}/lut.exr")
    execute_process(COMMAND ${step} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE failed)
    if(failed)
        message(FATAL_ERROR "${step}\n${output}")
    endif()
endforeach()
# D at the terminator of an 8 mm sphere, red: a number of the theory, not of this build.
if(NOT output MATCHES "red at N.L 0, r 8 mm: 0.04[0-9]")
    message(FATAL_ERROR "the consumer printed '${output}'")
endif()
execute_process(COMMAND ${work}/prefix/bin/dermis bake lut --size 8 -o ${work}/cli.csv RESULT_VARIABLE failed)
if(failed OR NOT EXISTS ${work}/cli.csv.json)
    message(FATAL_ERROR "the installed command line does not bake")
endif()
