# Every shader of shaders/ and techniques/ to SPIR-V at build time, embedded by name: "renderer/fullscreen.vert",
# "lambert/lambert.frag".
include_guard()
find_program(GLSLC glslc REQUIRED)

# dermis_embed_shaders(target): adds the generated table (defines dermis::built_in_shaders, see catalog/parts.h) to `target`.
function(dermis_embed_shaders target)
    file(GLOB sources CONFIGURE_DEPENDS
        ${PROJECT_SOURCE_DIR}/shaders/*/*.vert ${PROJECT_SOURCE_DIR}/shaders/*/*.frag
        ${PROJECT_SOURCE_DIR}/shaders/*/*.comp
        ${PROJECT_SOURCE_DIR}/techniques/*/*.vert ${PROJECT_SOURCE_DIR}/techniques/*/*.frag
        ${PROJECT_SOURCE_DIR}/techniques/*/*.comp)
    set(table "")
    set(outputs "")
    set(out_dir ${PROJECT_BINARY_DIR}/catalog/shaders)
    foreach(source ${sources})
        get_filename_component(file ${source} NAME)
        get_filename_component(folder ${source} DIRECTORY)
        get_filename_component(folder ${folder} NAME)
        set(output ${out_dir}/${folder}/${file}.inc)
        file(MAKE_DIRECTORY ${out_dir}/${folder})
        add_custom_command(OUTPUT ${output} DEPENDS ${source} DEPFILE ${output}.d
            COMMAND ${GLSLC} --target-env=vulkan1.3 -O -g -Werror -fauto-bind-uniforms -I ${PROJECT_SOURCE_DIR}
                -MD -MF ${output}.d -MT ${output} -mfmt=c -o ${output} ${source}
            COMMENT "Shader ${folder}/${file}" VERBATIM)
        list(APPEND outputs ${output})
        string(MAKE_C_IDENTIFIER "${folder}_${file}" id)
        string(APPEND arrays "static const uint32_t k_${id}[] =\n#include \"${output}\"\n;\n")
        string(APPEND table "    {\"${folder}/${file}\", k_${id}},\n")
    endforeach()
    file(CONFIGURE OUTPUT ${out_dir}/table.cpp @ONLY CONTENT
"#include \"catalog/parts.h\"

#include <vector>

${arrays}
std::span<const dermis::gpu::EmbeddedShader> dermis::built_in_shaders() {
    static const std::vector<gpu::EmbeddedShader> kTable = {
${table}    };
    return kTable;
}
")
    set_property(SOURCE ${out_dir}/table.cpp APPEND PROPERTY OBJECT_DEPENDS "${outputs}")
    target_sources(${target} PRIVATE ${out_dir}/table.cpp)
endfunction()
