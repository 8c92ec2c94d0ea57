#include "engines/unreal_head/graph.h"

namespace dermis::unreal_head {

using nlohmann::json;

namespace {

// Lengths are in centimetres, axes Unreal's.
constexpr const char* kPixel = R"(
cbuffer StubCamera { float4 stub_clip_0, stub_clip_1, stub_clip_2, stub_clip_3, stub_eye; };
struct Pixel {
    float4 place : SV_Position;
    float3 position : TEXCOORD0;
    float3 normal : TEXCOORD1;
    float3 tangent : TEXCOORD2;
    float4 uvs : TEXCOORD3;
};
)";
constexpr const char* kVertexMain = R"(
struct Vertex {
    float3 position : POSITION;
    float3 normal : NORMAL;
    float3 tangent : TANGENT;
    float2 uv_0 : TEXCOORD0;
    float2 uv_1 : TEXCOORD1;
};
Pixel main(Vertex input) {
    float4 h = float4(input.position, 1.0);
    Pixel pixel;
    pixel.place = float4(dot(stub_clip_0, h), dot(stub_clip_1, h), dot(stub_clip_2, h), dot(stub_clip_3, h));
    pixel.position = input.position;
    pixel.normal = input.normal;
    pixel.tangent = input.tangent;
    pixel.uvs = float4(input.uv_0, input.uv_1);
    return pixel;
}
)";
constexpr const char* kPluginShaders = "/Plugin/DermisSkin/";

// An input of the Custom node: its declaration as a parameter, and what is passed.
struct Input {
    std::string parameter, argument;
};

class Translator {
  public:
    explicit Translator(const json& editor) : editor_(editor) {}

    Result<Graph> translated(size_t custom) {
        const json& node = editor_["nodes"][custom];
        std::string parameters = "FMaterialPixelParameters Parameters", arguments = "parameters";
        for (const json& input : node["inputs"]) {
            const std::string name = input["input_name"];
            DERMIS_TRY_ASSIGN(const size_t source, linked(custom, name));
            DERMIS_TRY_ASSIGN(const Input made, input_of(name, source));
            parameters += ", " + made.parameter;
            arguments += ", " + made.argument;
        }
        std::string includes;
        for (std::string file : node["include_file_paths"]) {
            if (!file.starts_with(kPluginShaders)) return Error{"no file is at " + file};
            includes += "#include \"" + file.substr(std::string(kPluginShaders).size()) + "\"\n";
        }
        graph_.fragment = "SamplerState trilinear_clamp, linear_clamp;\n" + globals_ +
                          "cbuffer Material {\n" + block_ + "};\n" + kPixel +
                          "struct FMaterialPixelParameters { float4 SvPosition; };\n" + includes +
                          "float3 CustomExpression0(" + parameters + ") {\n" + std::string(node["code"]) +
                          "\n}\nfloat4 main(Pixel pixel) : SV_Target {\n"
                          "    FMaterialPixelParameters parameters = { pixel.place };\n"
                          "    return float4(CustomExpression0(" +
                          arguments + "), 1.0);\n}\n";
        return graph_;
    }

  private:
    Result<size_t> linked(size_t to, const std::string& input) const {
        for (const json& link : editor_["links"])
            if (link.contains("to") && link["to"] == to && link["input"] == input)
                return size_t(link["from"]);
        return Error{"nothing is connected to the input '" + input + "'"};
    }

    // A direction or a place, which is the same in the mesh's space: the mesh is at the origin, not turned.
    Result<std::string> in_local_space(size_t at, const char* source_space, const char* space) {
        const json& node = editor_["nodes"][at];
        if (node["transform_source_type"] != source_space || node["transform_type"] != space)
            return Error{"only from the world to the mesh's space is modelled"};
        DERMIS_TRY_ASSIGN(const size_t source, linked(at, ""));
        const json& from = editor_["nodes"][source];
        if (from["kind"] == "MaterialExpressionWorldPosition") return std::string("pixel.position");
        if (from["kind"] == "MaterialExpressionVectorParameter") return parameter_of(from) + ".rgb";
        if (from["kind"] != "MaterialExpressionConstant3Vector")
            return Error{"no transform of " + std::string(from["kind"]) + " is modelled"};
        const json& c = from["constant"];
        return "float3(" + c[0].dump() + ", " + c[1].dump() + ", " + c[2].dump() + ")";
    }

    Result<std::string> geometry_of(size_t at) {
        const json& node = editor_["nodes"][at];
        const std::string kind = node["kind"];
        if (kind == "MaterialExpressionVertexNormalWS") return std::string("normalize(pixel.normal)");
        if (kind == "MaterialExpressionVertexTangentWS") return std::string("pixel.tangent");
        if (kind == "MaterialExpressionCameraVectorWS")
            return std::string("normalize(stub_eye.xyz - pixel.position)");
        if (kind == "MaterialExpressionTransform")
            return in_local_space(at, "TRANSFORMSOURCE_WORLD", "TRANSFORM_LOCAL");
        if (kind == "MaterialExpressionTransformPosition")
            return in_local_space(at, "TRANSFORMPOSSOURCE_WORLD", "TRANSFORMPOSSOURCE_LOCAL");
        return Error{"the node " + kind + " is not modelled"};
    }

    Result<Input> input_of(const std::string& name, size_t at) {
        const json& node = editor_["nodes"][at];
        const std::string kind = node["kind"];
        if (kind == "MaterialExpressionTextureCoordinate")
            return Input{"float2 " + name, node["coordinate_index"] == 1 ? "pixel.uvs.zw" : "pixel.uvs.xy"};
        if (!node.contains("parameter_name")) {
            DERMIS_TRY_ASSIGN(const std::string value, geometry_of(at));
            return Input{"float3 " + name, value};
        }
        const std::string parameter = node["parameter_name"];
        if (kind == "MaterialExpressionTextureObjectParameter") {
            graph_.textures[parameter] = node["texture"]["asset"];
            globals_ += "Texture2D " + parameter + "Map;\n";
            return Input{"Texture2D " + name + ", SamplerState " + name + "Sampler",
                         parameter + "Map, trilinear_clamp"};
        }
        const bool is_scalar = kind == "MaterialExpressionScalarParameter";
        return Input{(is_scalar ? "float " : "float3 ") + name,
                     parameter_of(node) + (is_scalar ? "" : ".rgb")};
    }

    // A number or a colour, in the block Material.
    std::string parameter_of(const json& node) {
        const std::string name = node["parameter_name"];
        const bool is_scalar = node["kind"] == "MaterialExpressionScalarParameter";
        graph_.values[name] = node["default_value"];
        block_ += (is_scalar ? "    float " : "    float4 ") + name + "Value;\n";
        return name + "Value";
    }

    const json& editor_;
    Graph graph_;
    std::string globals_, block_;
};

}  // namespace

Result<Graph> material_graph(const json& editor, const std::string& path) {
    for (const json& link : editor["links"])
        if (link.contains("property") && link["property"] == "MP_EMISSIVE_COLOR" &&
            link["material"]["asset"] == path)
            return Translator(editor).translated(link["from"]);
    return Error{path + " emits nothing"};
}

std::string vertex_text() {
    return std::string(kPixel) + kVertexMain;
}

}  // namespace dermis::unreal_head
