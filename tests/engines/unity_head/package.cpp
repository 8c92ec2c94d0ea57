#include "engines/unity_head/package.h"

#include <algorithm>
#include <regex>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/image/colour.h"
#include "engines/drawn_head/drawing.h"

namespace dermis::unity_head {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace drawn_head;

namespace {

// glTFast: another handedness by x, and the origin of textures at the bottom. A position has a fourth number,
// as shaders read it.
void as_unity(Primitive& to, const std::string& name, const std::vector<float>& values) {
    const bool is_pair = name.starts_with("TEXCOORD_");
    const std::string semantic = is_pair ? "TEXCOORD" + name.substr(9) : name;
    std::vector<float>& made = to.attributes[semantic];
    const bool is_tangent = name == "TANGENT";
    for (size_t i = 0; i < values.size(); i += is_pair ? 2 : is_tangent ? 4 : 3) {
        if (is_pair)
            made.insert(made.end(), {values[i], 1 - values[i + 1]});
        else
            made.insert(made.end(), {-values[i], values[i + 1], values[i + 2]});
        if (name == "POSITION" || is_tangent) made.push_back(1);
    }
    to.components[semantic] = is_pair ? 2 : name == "POSITION" || is_tangent ? 4 : 3;
}

Result<std::string> meta_value(const std::string& meta, const std::string& name) {
    std::smatch found;
    if (std::regex_search(meta, found, std::regex("\\n *" + name + ": (\\S+)"))) return found[1].str();
    return Error{"the .meta has no " + name};
}

// Where an expression of SkinHead.cs leads in scene.json: "one.maps?.normal", "settings.baked_normals[0]",
// "1".
json evaluated(std::string expression, const json& settings, const json& item, const json& surface) {
    std::smatch found;
    if (std::regex_match(expression, found, std::regex("FromLinear\\(Numbers\\((.*)\\)\\)")))
        expression = found[1];
    if (std::regex_match(expression, found, std::regex("(.*) \\? 1 : 0")))
        return json(evaluated(found[1], settings, item, surface) == json(true) ? 1.0 : 0.0);
    if (std::regex_match(expression, std::regex("[0-9.]+"))) return json(std::stod(expression));
    if (std::regex_match(expression, found, std::regex("\"(.*)\""))) return json(found[1].str());
    expression = std::regex_replace(expression, std::regex("\\?"), "");
    const json* at = expression.starts_with("one.")        ? &surface
                     : expression.starts_with("item.")     ? &item
                     : expression.starts_with("settings.") ? &settings
                                                           : nullptr;
    if (!at) return json();
    const std::regex step("\\.(\\w+)|\\[(\\d)\\]");
    for (std::sregex_iterator i(expression.begin(), expression.end(), step), end; i != end; ++i) {
        const std::string name = (*i)[1], index = (*i)[2];
        if (!name.empty() ? !at->contains(name) : at->size() <= size_t(std::stoi(index))) return json();
        at = name.empty() ? &(*at)[size_t(std::stoi(index))] : &(*at)[name];
    }
    return *at;
}

// The properties' own values: Name("...", Type) = value.
void read_properties(const std::string& shader, Material& material) {
    const std::regex property(R"re((_\w+)\("[^"]*", (\w+)[^)]*\)?\) = ("\w+"|\([^)]*\)|[-0-9.]+))re");
    for (std::sregex_iterator i(shader.begin(), shader.end(), property), end; i != end; ++i) {
        const std::string name = (*i)[1], type = (*i)[2], value = (*i)[3];
        if (type == "2D") {
            material.standard_pictures[name] = value.substr(1, value.size() - 2);
        } else if (type == "Color") {
            for (const std::string_view part :
                 split(std::string_view(value).substr(1, value.size() - 2), ','))
                material.values[name].push_back(std::stof(std::string(part)));
            for (size_t c = 0; c < 3; ++c) material.values[name][c] = srgb_decode(material.values[name][c]);
        } else {
            material.values[name] = {std::stof(value)};
        }
    }
}

}  // namespace

Result<std::vector<Primitive>> import_glb(const fs::path& path, const Moment& moment) {
    DERMIS_TRY_ASSIGN(const Glb glb, read_glb(path));
    DERMIS_TRY_ASSIGN(const std::vector<PosedNode> nodes, posed_nodes(glb, moment));
    DERMIS_TRY_ASSIGN(const std::vector<PosedNode> opened, posed_nodes(glb, {}));
    std::vector<Primitive> primitives;
    for (size_t node = 0; node < nodes.size(); ++node) {
        const json& source = glb.document["nodes"][node];
        if (!source.contains("mesh")) continue;
        for (const json& one : glb.document["meshes"][size_t(source["mesh"])]["primitives"]) {
            Primitive made;
            const Shape shape = posed_shape(glb, nodes, node, one);
            as_unity(made, "POSITION", shape.positions);
            as_unity(made, "NORMAL", shape.normals);
            if (!shape.tangents.empty()) as_unity(made, "TANGENT", shape.tangents);
            for (const auto& [name, accessor] : one["attributes"].items())
                if (name.starts_with("TEXCOORD_")) as_unity(made, name, floats_of(glb, accessor));
            const json& mesh = glb.document["meshes"][size_t(source["mesh"])];
            if (mesh.contains("extras")) made.targets = mesh["extras"].value("targetNames", made.targets);
            for (size_t i = 0; i < made.targets.size(); ++i)
                made.target_weights.push_back(nodes[node].weights[i] - opened[node].weights[i]);
            made.indices = integers_of(glb, one["indices"]);
            made.material = glb.document["materials"][size_t(one["material"])]["name"];
            primitives.push_back(std::move(made));
        }
    }
    return primitives;
}

Result<gpu::TextureData> import_picture(const fs::path& path) {
    DERMIS_TRY_ASSIGN(const std::string meta, read_text_file(path.string() + ".meta"));
    DERMIS_TRY_ASSIGN(const std::string srgb, meta_value(meta, "sRGBTexture"));
    DERMIS_TRY_ASSIGN(const std::string has_mips, meta_value(meta, "enableMipMap"));
    return drawn_head::imported_picture(path, srgb == "1", has_mips == "1", true);
}

gpu::TextureData target_weights(const Primitive& primitive, const json& names) {
    Image picture(int(std::max<size_t>(primitive.targets.size(), 1)), 1, 4, PixelFormat::f16);
    int count = 0;
    for (size_t i = 0; i < primitive.targets.size(); ++i) {
        const auto found = std::ranges::find(names, json(primitive.targets[i]));
        if (found == names.end() || primitive.target_weights[i] == 0) continue;
        picture.set(count, 0, 0, float(found - names.begin()));
        picture.set(count++, 0, 1, float(primitive.target_weights[i]));
    }
    return {.name = "target weights",
            .format = ImageFormat::rgba16f,
            .width = picture.width,
            .height = 1,
            .bytes = std::move(picture.bytes)};
}

Result<Material> make_material(const fs::path& package, const json& settings, const json& item,
                               const json& surface) {
    DERMIS_TRY_ASSIGN(const std::string shader, read_text_file(package / "Head/SkinHead.shader"));
    DERMIS_TRY_ASSIGN(const std::string script, read_text_file(package / "Head/SkinHead.cs"));
    Material material;
    read_properties(shader, material);
    const std::regex call(R"re((Bind\(skin, |skin\.Set\w+\()"(_\w+)", (.*)\);)re");
    for (std::sregex_iterator i(script.begin(), script.end(), call), end; i != end; ++i) {
        const std::string function = (*i)[1], name = (*i)[2], expression = (*i)[3];
        if (function == "skin.SetTexture(") {
            material.pictures[name] = package / "Runtime/SkinTable.exr";
            continue;
        }
        const json value = evaluated(expression, settings, item, surface);
        if (value.is_null()) continue;
        if (function.starts_with("Bind"))
            material.pictures[name] = package / "Head" / std::string(value);
        else if (value.is_array())
            material.values[name] = {value[0], value[1], value[2], 1};
        else
            material.values[name] = {float(value)};
    }
    return material;
}

}  // namespace dermis::unity_head
