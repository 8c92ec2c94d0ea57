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
