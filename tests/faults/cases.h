#pragma once
// The commands that are run while their calls fail, and what each of them makes.

#include <ostream>

namespace dermis {

enum class Made {
    together,  ///< all files of out/, or none
    each,      ///< several results, of which one that is whole stays: a picture is not lost with its preview
    varies,    ///< its content differs from run to run
};

struct Case {
    const char* name;
    const char* arguments;
    Made made = Made::together;
    enum { quick, slow, draws } kind = quick;  ///< by Vulkan, a driver may crash on a failing allocation
    const char* prepare = nullptr;             ///< shell before it, in which nothing fails
    bool takes_seconds = false;                ///< only with DERMIS_FAULTS=all
};

inline void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name;
}

constexpr const char* kParts =
    "$DERMIS reference scene.toml --size 8x8 --samples 8 --probes 6 --sample-range 0:4 -o a.exr && "
    "$DERMIS reference scene.toml --size 8x8 --samples 8 --probes 6 --sample-range 4:8 -o b.exr";
constexpr const char* kPicture = "$DERMIS render scene.toml --size 16x16 -o a.exr";
constexpr const char* kAlbedo = "$DERMIS bake lut --size 16x16 --storage 8 -o a.png";
constexpr const char* kTable = "$DERMIS bake lut --size 16x16 --storage 8 -o table.png";

constexpr Case kCases[] = {
    {"bake_lut", "bake lut --size 32x32 -o out/a.exr"},
    {"bake_png", "bake lut --size 32x32 --storage 8 -o out/a.png"},
    {"plot", "bake lut --size 16x16 -o out/a.exr --plot out/a.svg", Made::each},
    {"bake_zh", "bake zh --size 16 -o out/a.exr"},
    {"bake_shadow", "bake shadow --size 16 -o out/a.exr"},
    {"bake_beckmann", "bake beckmann -o out/a.exr"},
    {"bake_closed_form", "bake closed_form"},
    {"bake_curvature", "bake curvature scene.toml --size 16 -o out/a.exr"},
    {"bake_thickness", "bake thickness scene.toml --size 16 --rays 4 -o out/a.exr"},
    {"bake_kernel_size", "bake kernel-size scene.toml --size 16 -o out/a.exr"},
    {"bake_stretch", "bake stretch scene.toml --size 16 -o out/a.exr"},
    {"bake_occlusion", "bake occlusion scene.toml --size 16 --rays 4 -o out/a.exr"},
    {"bake_gain", "bake gain scene.toml --size 16 --walks-per-mm2 0.1 -o out/a.exr"},
    {"bake_normals", "bake normals scene.toml --size 16 -o out/a.exr"},
    {"bake_pigments", "bake pigments a.png -o out/a.png", Made::together, Case::slow, kAlbedo},
    {"profile", "profile show gpu_gems_3"},
    {"profile_list", "profile list"},
    {"profile_convert", "profile convert gpu_gems_3 --to all"},
    {"profile_mtlx", "profile convert gpu_gems_3 --to openpbr -o out/a.mtlx"},
    {"profile_fit_walk", "profile fit-walk openpbr_skin_3 --walks 3000 -o out/a.csv"},
    {"new_scene", "new-scene cube.obj --unit-mm 50 -o out/a.toml"},
    {"lint", "lint table.png", Made::together, Case::slow, kTable},
    {"lint_sidecar", "lint out/a.dds --write-sidecar", Made::each, Case::slow,
     "$DERMIS bake lut --size 16x16 -o out/a.dds && rm out/a.dds.json"},
    {"info", "info cube.obj"},
    {"info_json", "info cube.obj --json"},
    {"info_scene", "info scene.toml"},
    {"keys", "keys"},
    {"techniques", "techniques"},
    {"subjects", "subjects --json"},
    {"reference", "reference scene.toml --size 8x8 --samples 2 --probes 6 -o out/a.exr"},
    {"part", "reference scene.toml --size 8x8 --samples 8 --probes 6 --sample-range 4:8 -o out/a.exr"},
    {"merge", "merge a.exr b.exr -o out/a.exr --preview out/a.png", Made::each, Case::quick, kParts},
    {"merge_check", "merge --check a.exr b.exr", Made::together, Case::quick, kParts},
    {"jobs_list", "jobs commands.txt --folder out/jobs"},
    {"jobs_local", "jobs commands.txt --folder out/jobs --runner local", Made::varies},
    {"export", "export --language hlsl -o out/a.hlsl", Made::together, Case::slow},
    {"export_all", "export --language all -o out/all", Made::together, Case::slow},
    {"export_engine", "export --engine unity -o out/unity", Made::together, Case::slow},
    {"export_functions", "export --language hlsl --functions skin_diffuse -o out/a.hlsl"},
    {"export_native", "export --engine unity_hdrp --native -o out/native"},
    {"export_scene", "export --engine three scene.toml -o out/three", Made::together, Case::draws, nullptr,
     true},
    {"export_obj", "export-mesh builtin:bust -o out/a.obj", Made::together, Case::slow},
    {"export_pose", "export-mesh sheet.gltf --clip nod --time 0.5 -o out/a.obj"},
    {"info_clips", "info sheet.gltf"},
    {"passes", "passes lambert"},
    {"report", "report", Made::together, Case::draws},
    {"export_web", "export --web scene.toml -o out/page", Made::each, Case::draws},
    {"cost", "cost lambert --fragments-of scene.toml --size 16x16", Made::together, Case::draws},
    {"render_clip", "render sheet.gltf --clip nod --fps 2 --frames 2 --size 16x16 -o out/%02d.png",
     Made::each, Case::draws},
    {"figures", "figures preintegrated --only table --size 32 -o out", Made::each, Case::draws},
    {"render", "render scene.toml --size 16x16 -o out/a.png", Made::together, Case::draws},
    {"turntable", "view scene.toml --turntable 2 --size 16x16 -o out/%04d.png", Made::each, Case::draws},
    {"view", "view scene.toml --size 32x32 --samples 1 --frames 1", Made::together, Case::draws},
    {"compare",
     "compare scene.toml --size 16x16 --samples 8 --samples-per-pixel 4 --timed-frames 1 -t lambert -o out",
     Made::varies, Case::draws},
    {"compare_picture",
     "compare scene.toml --samples 8 --samples-per-pixel 4 --timed-frames 1 -t lambert --picture "
     "a=a.exr,a.exr -o "
     "out",
     Made::varies, Case::draws, kPicture},
};

}  // namespace dermis
