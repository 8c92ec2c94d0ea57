# Files of the repository as text in a program.
include_guard()

# dermis_embed_texts(target HEADER catalog/catalog.h FUNCTION built_in_x TYPE shading::Source FROM folder FILES ...):
# defines dermis::<FUNCTION>(), which HEADER declares: a span of TYPE {path from `folder`, text}.
function(dermis_embed_texts target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "HEADER;FUNCTION;TYPE;FROM" "FILES")
    set(table "")
    foreach(path ${arg_FILES})
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
        file(RELATIVE_PATH name ${arg_FROM} ${path})
        file(READ ${path} text)
        string(APPEND table "        {\"${name}\", R\"dermis_text(${text})dermis_text\"},\n")
    endforeach()
    string(MAKE_C_IDENTIFIER ${arg_FUNCTION} file)
    set(output ${PROJECT_BINARY_DIR}/texts/${file}.cpp)
    # Not file(CONFIGURE): it would replace the @words@ of the texts.
    file(WRITE ${output}.new "#include \"${arg_HEADER}\"

#include <vector>

std::span<const dermis::${arg_TYPE}> dermis::${arg_FUNCTION}() {
    static const std::vector<dermis::${arg_TYPE}> kTexts = {
${table}    };
    return kTexts;
}
")
    file(COPY_FILE ${output}.new ${output} ONLY_IF_DIFFERENT)
    target_sources(${target} PRIVATE ${output})
endfunction()
