# Build rules: one library target per folder of dermis/, linking what the folder includes and nothing else.
# A header is included by its path in this tree, "dermis/folder/header.h", which is also its path when installed.
include_guard()

set_property(GLOBAL PROPERTY DERMIS_LAYERS "")

# Most of compiling is parsing headers, again in every file. What nearly every file includes is parsed once (a
# precompiled header; -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON goes without), and the compiler is given the files of a
# library eight at a time (DERMIS_UNITY). Together they halve the processor time of a first build.
set(DERMIS_STANDARD_HEADERS <algorithm> <array> <atomic> <cmath> <cstdint> <cstdio> <cstring> <filesystem> <functional>
    <map> <memory> <numbers> <optional> <set> <span> <string> <string_view> <utility> <variant> <vector>)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/standard_headers.cpp CONTENT
    "// Carries the precompiled header that the libraries share.\n")
add_library(dermis_standard_headers OBJECT ${PROJECT_BINARY_DIR}/standard_headers.cpp)
target_compile_options(dermis_standard_headers PRIVATE ${DERMIS_WARNINGS})
target_precompile_headers(dermis_standard_headers PRIVATE ${DERMIS_STANDARD_HEADERS})

# dermis_quick_build(target [BY_FOLDER]): both for one library.
#   BY_FOLDER  the files of each folder for themselves: several folders use the same names, as every technique has its Params
function(dermis_quick_build target)
    cmake_parse_arguments(arg "BY_FOLDER" "" "" ${ARGN})
    target_precompile_headers(${target} REUSE_FROM dermis_standard_headers)
    if(NOT DERMIS_UNITY)
        return()
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    if(arg_BY_FOLDER)
        set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
        get_target_property(sources ${target} SOURCES)
        set(index 0)
        foreach(source ${sources})  # sorted by folder
            get_filename_component(folder ${source} DIRECTORY)
            get_filename_component(folder "${folder}" NAME)
            math(EXPR batch "${index} / 8")
            set_source_files_properties(${source} PROPERTIES UNITY_GROUP "${folder}_${batch}")
            math(EXPR index "${index} + 1")
        endforeach()
    endif()
endfunction()

# dermis_of_this_system(sources): without the files of other systems, posix*.cpp or windows*.cpp.
function(dermis_of_this_system files)
    if(WIN32)
        list(FILTER ${files} EXCLUDE REGEX "/posix[a-z_]*\\.cpp$")
    else()
        list(FILTER ${files} EXCLUDE REGEX "/windows[a-z_]*\\.cpp$")
    endif()
    set(${files} ${${files}} PARENT_SCOPE)
endfunction()

# dermis_library(optics DEPENDS base PACKAGES Eigen3::Eigen [INSTALL PUBLIC_HEADERS profile.h])
#   DEPENDS   the folders of dermis/ whose headers this one includes: all of them and no other. Also written to
#             layers.txt, which a test compares with every #include
#   PACKAGES  third-party targets that are linked, never visible in a public header
#   HEADERS   third-party targets that are headers alone (cmake/Parts.cmake)
#   LEFT_OUT  files of this folder that are not compiled: those of a part that is not built in
#   INSTALL   part of the CPU library that engines link
#   PUBLIC_HEADERS  what an engine's build includes; dermis/dermis.h includes each, docs/library.md shows their use
function(dermis_library folder)
    cmake_parse_arguments(arg "INSTALL" "" "DEPENDS;PACKAGES;HEADERS;LEFT_OUT;PUBLIC_HEADERS" ${ARGN})
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp ${CMAKE_CURRENT_SOURCE_DIR}/*/*.cpp)
    dermis_of_this_system(sources)
    foreach(file ${arg_LEFT_OUT})
        list(REMOVE_ITEM sources ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    endforeach()
    if(sources)
        add_library(dermis_${folder} STATIC ${sources})
        set(scope PUBLIC)
        target_link_libraries(dermis_${folder} PRIVATE ${arg_PACKAGES} "$<BUILD_INTERFACE:${arg_HEADERS}>")
        target_compile_options(dermis_${folder} PRIVATE ${DERMIS_WARNINGS})
        dermis_quick_build(dermis_${folder})
    else()
        add_library(dermis_${folder} INTERFACE)
        set(scope INTERFACE)
    endif()
    add_library(dermis::${folder} ALIAS dermis_${folder})
    set_target_properties(dermis_${folder} PROPERTIES EXPORT_NAME ${folder})
    target_include_directories(dermis_${folder} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
        $<INSTALL_INTERFACE:include>)
    target_compile_features(dermis_${folder} ${scope} cxx_std_20)
    foreach(dependency ${arg_DEPENDS})
        target_link_libraries(dermis_${folder} ${scope} dermis_${dependency})
    endforeach()
    list(JOIN arg_DEPENDS " " dependencies)
    set_property(GLOBAL APPEND PROPERTY DERMIS_LAYERS "${folder}: ${dependencies}")
    if(arg_INSTALL)
        set_property(GLOBAL APPEND PROPERTY DERMIS_INSTALLED ${folder})
        set_property(GLOBAL PROPERTY DERMIS_HEADERS_OF_${folder} ${arg_PUBLIC_HEADERS})
    endif()
endfunction()

# dermis_test_program(test_optics LINK optics bake SOURCES a_test.cpp): a gtest program.
#   OPTIMIZED its own code computes for seconds
function(dermis_test_program target)
    cmake_parse_arguments(arg "OPTIMIZED" "" "LINK;SOURCES" ${ARGN})
    add_executable(${target} ${arg_SOURCES})
    foreach(library ${arg_LINK})
        target_link_libraries(${target} PRIVATE dermis_${library})
    endforeach()
    target_link_libraries(${target} PRIVATE GTest::gtest GTest::gtest_main GTest::gmock)
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_BINARY_DIR}/tests/include)
    # Compiling takes a third of a test run's time: no optimisation, GoogleTest's headers parsed once, large batches.
    target_compile_options(${target} PRIVATE ${DERMIS_WARNINGS} $<IF:$<BOOL:${arg_OPTIMIZED}>,-O1,-O0>)
    if(NOT arg_OPTIMIZED)
        target_precompile_headers(${target} REUSE_FROM test_headers)
    endif()
    if(DERMIS_UNITY)
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
        # A batch includes its files: GCC takes them for headers, in which a class of an unnamed namespace is a mistake.
        # GoogleTest's macros are safe after an `if`; GCC knows that of them in a file of its own only.
        target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage -Wno-dangling-else>)
    endif()
    set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
endfunction()

# dermis_test_folder(optics LINK optics bake): every tests/optics/*_test.cpp in one program, a ctest entry per suite.
#   WHOLE     one entry: all of it shares something slow to make
#   OPTIMIZED as above
function(dermis_test_folder folder)
    cmake_parse_arguments(arg "WHOLE;OPTIMIZED" "" "LINK" ${ARGN})
    file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${folder}/*.cpp)
    dermis_of_this_system(sources)
    if(NOT sources)
        return()
    endif()
    set(options "")
    if(arg_OPTIMIZED)
        set(options OPTIMIZED)
    endif()
    dermis_test_program(test_${folder} ${options} LINK ${arg_LINK} SOURCES ${sources})
    set(properties TIMEOUT 600)
    if(arg_WHOLE)
        # ctest starts what costs most first: the longest would keep one core at the end.
        set(properties TIMEOUT 1800 COST 1000)
    endif()
    if(CMAKE_CROSSCOMPILING)
        set(properties TIMEOUT 1200)  # a whole folder by an emulator
    endif()
    # What Vulkan drivers and layers keep until the end is reported without a module, as they are unloaded by then:
    # nothing to suppress it by. The folders without Vulkan look for leaks. A long quarantine of freed memory would look
    # like growth to the test that watches for it.
    if(DERMIS_SANITIZE AND "${folder};${arg_LINK}" MATCHES "gpu|render|technique|cli|view|judge|report|engines")
        list(APPEND properties ENVIRONMENT "ASAN_OPTIONS=detect_leaks=0:quarantine_size_mb=1")
    endif()
    # An emulator takes a second to start, and ctest cannot list the tests through it: as one test.
    if(CMAKE_CROSSCOMPILING)
        add_test(NAME ${folder} COMMAND test_${folder})
        set_tests_properties(${folder} PROPERTIES ${properties})
        return()
    endif()
    set(list ${CMAKE_CURRENT_BINARY_DIR}/${folder}_suites.cmake)
    file(GENERATE OUTPUT ${list} CONTENT
"set(FOLDER [[${folder}]])
set(PROGRAM [[$<TARGET_FILE:test_${folder}>]])
set(DIRECTORY [[${CMAKE_CURRENT_BINARY_DIR}]])
set(PROPERTIES [[${properties}]])
set(LONG [[${DERMIS_LONG_TESTS}]])
set(WHOLE [[${arg_WHOLE}]])
include([[${PROJECT_SOURCE_DIR}/cmake/Suites.cmake]])
")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${list})
endfunction()
