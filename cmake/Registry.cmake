# A list of every file (or folder) of a kind, generated so that adding one touches nothing else.

# dermis_registry(OUT file NAMES a;b SIGNATURE "void add_@_command(dermis::cli::CommandLine&)" ...) writes a source
# file that declares SIGNATURE for every name (@ stands for it) and defines `DEFINITION` with CALL for each in turn.
function(dermis_registry)
    cmake_parse_arguments(PARSE_ARGV 0 arg "" "OUT;INCLUDE;SIGNATURE;CALL;HEAD;TAIL" "NAMES")
    set(declarations "")
    set(calls "")
    foreach(name ${arg_NAMES})
        string(REPLACE "@" "${name}" declaration "${arg_SIGNATURE}")
        string(REPLACE "@" "${name}" call "${arg_CALL}")
        string(APPEND declarations "${declaration};\n")
        string(APPEND calls "    ${call}\n")
    endforeach()
    file(CONFIGURE OUTPUT ${arg_OUT} CONTENT
        "#include \"${arg_INCLUDE}\"\n\n${declarations}\n${arg_HEAD}\n${calls}${arg_TAIL}\n" @ONLY)
endfunction()

# dermis_folders_of(technique.cpp DERMIS_TECHNIQUES): the folders here that have this file, as a global property of that
# name; `sources` gets their source files without tests.
macro(dermis_folders_of definition property)
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*/*.cpp)
    list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
    file(GLOB definitions CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*/${definition})
    foreach(path ${definitions})
        get_filename_component(folder ${path} DIRECTORY)
        get_filename_component(name ${folder} NAME)
        set_property(GLOBAL APPEND PROPERTY ${property} ${name})
    endforeach()
endmacro()
