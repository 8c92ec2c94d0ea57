#pragma once
// The material that a plugin's script has made, as the text of a shader: what Unreal's compiler of materials
// would put around the Custom node, for the nodes that the script connects to it.

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "dermis/base/result.h"

namespace dermis::unreal_head {

struct Graph {
    std::string fragment;                          ///< HLSL; values are in the block Material
    std::map<std::string, std::string> textures;   ///< paths of assets by their parameter
    std::map<std::string, nlohmann::json> values;  ///< a number or four of each other parameter
};

/// The graph of the material at this path of the content browser. `editor`: the JSON that unreal.py prints.
/// Errors: a material without a Custom node, an input without a link, a node that is not modelled.
[[nodiscard]] Result<Graph> material_graph(const nlohmann::json& editor, const std::string& path);

/// The text of the vertex shader.
[[nodiscard]] std::string vertex_text();

}  // namespace dermis::unreal_head
