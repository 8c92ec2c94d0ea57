#pragma once
// An exported Unity package as Unity would have it after its import: the meshes as glTFast gives them, the
// pictures by the settings of their .meta files, and the material as SkinHead.cs sets it. What that script
// binds is read from its text, so that a map that it leaves out is left out here.

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"
#include "dermis/gpu/device.h"
#include "engines/unity_head/pose.h"

namespace dermis::unity_head {

/// One draw: attributes by their semantic ("POSITION", "TEXCOORD3"), with x mirrored and 1 - y in each pair
/// of texture coordinates.
struct Primitive {
    std::map<std::string, std::vector<float>> attributes;
    std::map<std::string, int> components;
    std::vector<uint32_t> indices;
    std::string material;
    std::vector<std::string> targets;    ///< names of its blend shapes
    std::vector<double> target_weights;  ///< one each, beyond that in which the file opens
};

[[nodiscard]] Result<std::vector<Primitive>> import_glb(const std::filesystem::path& path,
                                                        const Moment& moment);

/// A picture with the bottom row first, as Unity has it, by the .meta beside it: encoding and mip levels.
[[nodiscard]] Result<gpu::TextureData> import_picture(const std::filesystem::path& path);

/// A material: what the shader's properties and SkinHead.cs say. `item`: its object in scene.json.
struct Material {
    std::map<std::string, std::vector<float>> values;       ///< one number, or a linear colour
    std::map<std::string, std::filesystem::path> pictures;  ///< by property
    std::map<std::string, std::string> standard_pictures;   ///< "white", "black", "bump": no file is bound
};

[[nodiscard]] Result<Material> make_material(const std::filesystem::path& package,
                                             const nlohmann::json& settings, const nlohmann::json& item,
                                             const nlohmann::json& surface);

/// The picture that SkinHead.cs makes of the weights of a primitive's blend shapes, by their names in
/// scene.json: as half floats a target's number and its weight.
[[nodiscard]] gpu::TextureData target_weights(const Primitive& primitive, const nlohmann::json& names);

}  // namespace dermis::unity_head
