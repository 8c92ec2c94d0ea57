// Import settings of the tables against what each engine needs, and that a wrong one is found.

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "engines/packages.h"

namespace dermis {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A line that the file must have, and how often: once, or in each platform's block.
struct Needed {
    std::string line;
    int count = 1;
};

const std::vector<Needed> kUnity = {
    {"    sRGBTexture: 0"},   // linear numbers
    {"    enableMipMap: 0"},  // rows are curvatures: a smaller level mixes them
    {"    wrapU: 1"},         // clamped
    {"    wrapV: 1"},
    {"    filterMode: 1"},  // bilinear
    {"    aniso: 0"},
    {"  nPOTScale: 0"},
    {"  ignoreMipmapLimit: 1"},  // quality settings would halve it
    {"  textureType: 0"},
    {"  alphaUsage: 0"},
    {"    textureCompression: 0", 5},
    {"    crunchedCompression: 0", 5},
    {"    maxTextureSize: 2048", 5},
    {"    overridden: 0", 5},
};
const std::vector<Needed> kGodot = {
    {"importer=\"texture\""},
    {"compress/mode=0"},
    {"mipmaps/generate=false"},
    {"detect_3d/compress_to=0"},  // else it is compressed at the first use in 3D
    {"process/size_limit=0"},
    {"process/hdr_as_srgb=false"},
    {"process/hdr_clamp_exposure=false"},
    {"process/premult_alpha=false"},
    {"source_file=\"res://addons/dermis_skin/skin_table.exr\""},
};
const std::vector<Needed> kGodotShader = {
    {"uniform sampler2D skin_table : filter_linear, repeat_disable;"},
};
const std::vector<Needed> kUnreal = {
    {"    \"srgb\": False,"},
    {"    \"compression_settings\": unreal.TextureCompressionSettings.TC_HDR,"},
    {"    \"mip_gen_settings\": unreal.TextureMipGenSettings.TMGS_NO_MIPMAPS,"},
    {"    \"filter\": unreal.TextureFilter.TF_BILINEAR,"},
    {"    \"address_x\": unreal.TextureAddress.TA_CLAMP,"},
    {"    \"address_y\": unreal.TextureAddress.TA_CLAMP,"},
    {"    \"never_stream\": True,"},
    {"    \"max_texture_size\": 0,"},
};

const std::vector<Needed> kThree = {
    {"  colorSpace: NoColorSpace,"},   {"  type: HalfFloatType,"},     {"  wrapS: ClampToEdgeWrapping,"},
    {"  wrapT: ClampToEdgeWrapping,"}, {"  minFilter: LinearFilter,"},  // no mip levels
    {"  magFilter: LinearFilter,"},    {"  generateMipmaps: false,"},  {"  anisotropy: 1,"},
};

const std::vector<Needed> kBabylon = {
    {"  gammaSpace: false,"},
    {"  wrapU: Constants.TEXTURE_CLAMP_ADDRESSMODE,"},
    {"  wrapV: Constants.TEXTURE_CLAMP_ADDRESSMODE,"},
    {"  anisotropicFilteringLevel: 1,"},
    {"  noMipmap: true,"},
    {"  samplingMode: Constants.TEXTURE_BILINEAR_SAMPLINGMODE,"},
    {"  textureType: Constants.TEXTURETYPE_HALF_FLOAT,"},
    {"      invertY: false,"},
};

struct Settings {
    std::string engine, path;
    std::vector<Needed> needed;
};

const std::vector<Settings>& all_settings() {
    static const std::vector<Settings> all = {
        {"unity", "Runtime/SkinTable.exr.meta", kUnity},
        {"godot", "addons/dermis_skin/skin_table.exr.import", kGodot},
        {"godot", "addons/dermis_skin/skin_surface.gdshaderinc", kGodotShader},
        {"unreal", "DermisSkin/Content/Python/dermis_skin.py", kUnreal},
        {"three", "SkinTable.js", kThree},
        {"babylon", "SkinTable.js", kBabylon},
    };
    return all;
}

// The needed lines that the text has not, or not as often.
std::vector<std::string> missing(const std::string& text, const std::vector<Needed>& needed) {
    std::vector<std::string> lines;
    for (size_t at = 0, end; at < text.size(); at = end + 1) {
        end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
    }
    std::vector<std::string> wrong;
    for (const Needed& need : needed)
        if (std::ranges::count(lines, need.line) != need.count) wrong.push_back(need.line);
    return wrong;
}

TEST(ImportSettings, are_those_that_each_engine_needs) {
    for (const Settings& settings : all_settings()) {
        const auto files = package_of(settings.engine, "openpbr_skin_5");
        ASSERT_EQ(files.count(settings.path), 1u) << settings.path;
        EXPECT_THAT(missing(files.at(settings.path), settings.needed), IsEmpty()) << settings.path;
    }
}

// One wrong setting in each file, and in one of Unity's platforms.
TEST(ImportSettings, with_a_mistake_are_found) {
    for (const Settings& settings : all_settings()) {
        const std::string text = package_of(settings.engine, "openpbr_skin_5").at(settings.path);
        for (const Needed& need : settings.needed) {
            std::string wrong = text;
            wrong.replace(wrong.find(need.line) + need.line.size() - 1, 1, "x");
            EXPECT_THAT(missing(wrong, settings.needed), ElementsAre(need.line)) << settings.path;
        }
    }
}

std::string guid_in(const std::string& meta) {
    const std::string word = "guid: ";
    return meta.substr(meta.find(word) + word.size(), 32);
}

TEST(UnityMeta, is_beside_every_file_and_folder_with_a_guid_of_its_own) {
    const auto files = package_of("unity", "openpbr_skin_5");
    std::set<std::string> guids;
    size_t metas = 0;
    for (const auto& [path, text] : files) {
        if (path.ends_with(".meta")) {
            ++metas;
            EXPECT_EQ(guid_in(text).find_first_not_of("0123456789abcdef"), std::string::npos) << path;
            guids.insert(guid_in(text));
            continue;
        }
        EXPECT_EQ(files.count(path + ".meta"), path.starts_with("Documentation~") ? 0u : 1u) << path;
    }
    EXPECT_EQ(guids.size(), metas);
    EXPECT_EQ(files.count("Runtime.meta"), 1u);
    EXPECT_EQ(files.count("Samples~.meta"), 0u) << "Unity does not import a folder that ends in ~";
}

// The same for every skin: a project's references survive a new export.
TEST(UnityMeta, keeps_its_guids_and_the_material_points_at_them) {
    const auto files = package_of("unity", "openpbr_skin_5"), other = package_of("unity", "gpu_gems_3");
    for (const auto& [path, text] : files)
        if (path.ends_with(".meta")) {
            EXPECT_EQ(text, other.at(path)) << path;
        }
    const std::string& material = files.at("Samples~/Sphere/Skin.mat");
    EXPECT_THAT(material, testing::HasSubstr("m_Shader: {fileID: 4800000, guid: " +
                                             guid_in(files.at("Runtime/Skin.shader.meta"))));
    EXPECT_THAT(material, testing::HasSubstr("m_Texture: {fileID: 2800000, guid: " +
                                             guid_in(files.at("Runtime/SkinTable.exr.meta"))));
}

}  // namespace
}  // namespace dermis
