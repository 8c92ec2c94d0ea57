# A cache entry is valid while the code that made it is the same.
# dermis_source_version(judge reference_version FOLDERS base rays FILES effect_reference.cpp) defines
# `std::string_view dermis::reference_version()` for the folder judge: a hash of these folders of dermis/ and these files,
# without line comments and line breaks, made anew by the build when one of them changes. dermis/judge/reference_version.h
# declares it.
if(NOT CMAKE_SCRIPT_MODE_FILE)
    include_guard()
    function(dermis_source_version folder name)
        cmake_parse_arguments(arg "" "" "FOLDERS;FILES" ${ARGN})
        foreach(hashed ${arg_FOLDERS})
            file(GLOB_RECURSE files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/dermis/${hashed}/*.h
                ${PROJECT_SOURCE_DIR}/dermis/${hashed}/*.cpp)
            list(APPEND arg_FILES ${files})
        endforeach()
        set(output ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
        string(REPLACE ";" " " files "${arg_FILES}")  # no ; in an argument of a command line
        add_custom_command(OUTPUT ${output} DEPENDS ${arg_FILES} ${PROJECT_SOURCE_DIR}/cmake/SourceVersion.cmake
            COMMAND ${CMAKE_COMMAND} -D "files=${files}" -D root=${PROJECT_SOURCE_DIR} -D folder=${folder} -D name=${name}
                -D output=${output} -P ${PROJECT_SOURCE_DIR}/cmake/SourceVersion.cmake
            COMMENT "Hashing the sources behind ${name}()" VERBATIM)
        target_sources(dermis_${folder} PRIVATE ${output})
    endfunction()
    return()
endif()

cmake_minimum_required(VERSION 3.25)
separate_arguments(files)
set(all "")
foreach(file ${files})
    file(READ ${file} text)
    string(REGEX REPLACE "//[^\n]*" "" text "${text}")
    string(REGEX REPLACE "[ \t\n]+" " " text "${text}")
    file(RELATIVE_PATH path ${root} ${file})
    string(SHA256 hash "${path}\n${text}")
    string(APPEND all "${hash}\n")
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING ${hash} 0 16 hash)
file(CONFIGURE OUTPUT ${output} @ONLY CONTENT "// Made by cmake/SourceVersion.cmake.
#include \"dermis/@folder@/@name@.h\"

std::string_view dermis::@name@() {
    return \"@hash@\";
}
")
