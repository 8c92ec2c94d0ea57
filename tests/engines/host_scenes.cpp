#include "engines/host_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "dermis/base/file.h"
#include "dermis/base/vec.h"
#include "dermis/image/io.h"
#include "dermis/scene/panorama.h"
#include "engines/host_transmission.h"

namespace dermis {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kRadiusMm = kHostRadiusMm;
constexpr Vec3 kToLight{-0.6275f, 0.5736f, 0.5266f};

// Radiance from all around: a, b, c, d of a + b x + c y + d x z, a channel each. No band above the third.
constexpr float kRadiance[3][4] = {
    {0.5f, 0.3f, 0.1f, 0.2f}, {0.4f, -0.1f, 0.2f, 0.15f}, {0.45f, 0.1f, -0.2f, -0.2f}};
// Of a hemisphere light: a + c y.
constexpr float kHemisphere[3][2] = {{0.4f, 0.3f}, {0.4f, 0.1f}, {0.5f, -0.2f}};
constexpr Vec3 kPointMm{-80, 72, 68};
constexpr float kPointIntensity = 0.04f;  // irradiance at 1 m; three.js has no falloff within 100 mm

// Of the spot light at kPointMm: the edge of its cone passes over the sphere. Babylon.js has no sharper edge
// than 0.001 of the cosine.
constexpr float kSpotIntensity = 0.05f, kSpotInnerDeg = 29.85f, kSpotOuterDeg = 30;
constexpr float kSpotAsideMm = 73;  // of its target

// Together: two directional lights and the point.
struct Distant {
    float yaw_deg, pitch_deg;
    Vec3 color;  // times pi: the irradiance
};
constexpr Distant kDistant[] = {{-50, 35, {0.5f, 0.4f, 0.3f}}, {75, -20, {0.1f, 0.2f, 0.4f}}};

std::array<float, 3> channels(Vec3 v) {
    return {v.x, v.y, v.z};
}

Image panorama_of(const auto& radiance) {
    Image image(256, 128, 3, PixelFormat::f32);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                image.set(x, y, c, radiance(panorama_direction((x + 0.5f) / 256, (y + 0.5f) / 128), c));
    return image;
}

// Slopes along u and v, 16 and 8 waves.
Image bumps() {
    Image image(512, 256, 3, PixelFormat::u8);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double u = (x + 0.5) / image.width, v = 1 - (y + 0.5) / image.height;
            const Vec3 n = normalize(
                Vec3{float(-0.25 * std::sin(2 * kPi * 16 * u)), float(-0.25 * std::cos(2 * kPi * 8 * v)), 1});
            for (int c = 0; c < 3; ++c) image.set(x, y, c, 0.5f * channels(n)[size_t(c)] + 0.5f);
        }
    return image;
}

struct HostMesh {
    std::vector<Vec3> positions_mm, normals;
    std::vector<Vec2> uvs;
    std::vector<int> indices;
};

HostMesh sphere() {
    constexpr int kAcross = 192, kDown = 96;
    HostMesh mesh;
    for (int j = 0; j <= kDown; ++j)
        for (int i = 0; i <= kAcross; ++i) {
            const double u = double(i) / kAcross, v = double(j) / kDown;
            // u grows towards +X in front, v upwards.
            const double across = 2 * kPi * (u - 0.5), up = kPi * (v - 0.5);
            const Vec3 n{float(std::sin(across) * std::cos(up)), float(std::sin(up)),
                         float(std::cos(across) * std::cos(up))};
            mesh.positions_mm.push_back(kRadiusMm * n);
            mesh.normals.push_back(n);
            mesh.uvs.push_back({float(u), float(v)});
            if (i == kAcross || j == kDown) continue;
            const int first = j * (kAcross + 1) + i, above = first + kAcross + 1;
            if (j > 0) mesh.indices.insert(mesh.indices.end(), {first, first + 1, above + 1});
            if (j + 1 < kDown) mesh.indices.insert(mesh.indices.end(), {first, above + 1, above});
        }
    return mesh;
}

constexpr int kCardEdgeMm = 2;
Vec3 card_side() {
    return normalize(cross(Vec3{0, 1, 0}, kToLight));
}

// Between light and sphere, outside of the picture; an edge of its shadow passes beside the middle of the
// sphere.
HostMesh card() {
    const Vec3 side = card_side(), up = cross(kToLight, side);
    const Vec3 middle = 60.0f * kToLight;
    HostMesh mesh;
    for (const auto& [x, y] :
         {std::pair{kCardEdgeMm - 24, -12}, {kCardEdgeMm, -12}, {kCardEdgeMm, 12}, {kCardEdgeMm - 24, 12}}) {
        mesh.positions_mm.push_back(middle + float(x) * side + float(y) * up);
        mesh.normals.push_back(kToLight);
        mesh.uvs.push_back({0, 0});
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

void add_square(HostMesh& mesh, Vec3 middle, Vec3 x, Vec3 y, float u) {
    const int first = int(mesh.positions_mm.size());
    for (const Vec3& corner : {-x - y, x - y, x + y, y - x}) {
        mesh.positions_mm.push_back(middle + corner);
        mesh.normals.push_back(normalize(cross(x, y)));
        mesh.uvs.push_back({u, 0.5f});
    }
    for (const int i : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(first + i);
}

// Skin of an even thickness, larger than the picture, and a board behind it before the light.
HostMesh sheet() {
    HostMesh mesh;
    const Vec3 x = {14, 0, 0}, y = {0, 14, 0}, half = {0, 0, 0.5f * thickness_mm(kSheetU)};
    add_square(mesh, half, x, y, kSheetU);
    add_square(mesh, -half, -x, y, kSheetU);
    return mesh;
}
HostMesh board() {
    HostMesh mesh;
    add_square(mesh, {kBoardEdgeMm - 40, 0, kBoardZMm}, {40, 0, 0}, {0, 60, 0}, 0);
    return mesh;
}

std::string obj_of(const HostMesh& mesh) {
    std::string text = "mtllib sphere.mtl\nusemtl skin\n";
    const auto line = [&](const char* word, std::initializer_list<float> values) {
        text += word;
        for (const float value : values) text += " " + std::to_string(value);
        text += "\n";
    };
    for (const Vec3& p : mesh.positions_mm) line("v", {p.x, p.y, p.z});
    for (const Vec2& uv : mesh.uvs) line("vt", {uv.x, uv.y});
    for (const Vec3& n : mesh.normals) line("vn", {n.x, n.y, n.z});
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::string index = std::to_string(mesh.indices[i] + 1);
        text += (i % 3 == 0 ? "f " : " ") + index + "/" + index + "/" + index + (i % 3 == 2 ? "\n" : "");
    }
    return text;
}

nlohmann::json json_of(const HostMesh& mesh) {
    nlohmann::json found = {{"indices", mesh.indices}};
    for (const Vec3& p : mesh.positions_mm)
        for (const float x : channels(p)) found["positions_mm"].push_back(x);
    for (const Vec3& n : mesh.normals)
        for (const float x : channels(n)) found["normals"].push_back(x);
    // Without them the engines scale bumps by the texture's stretch.
    for (const Vec3& n : mesh.normals) {
        const float across = std::atan2(n.x, n.z);
        for (const float x : {std::cos(across), 0.0f, -std::sin(across), 1.0f})
            found["tangents"].push_back(x);
    }
    for (const Vec2& uv : mesh.uvs) {
        found["uvs"].push_back(uv.x);
        found["uvs"].push_back(uv.y);
    }
    return found;
}

// In the order and basis of three.js, which are those of dermis/scene/environment.h.
nlohmann::json radiance_sh() {
    std::vector<std::vector<float>> sh(9, std::vector<float>(3, 0));
    for (size_t c = 0; c < 3; ++c) {
        sh[0][c] = kRadiance[c][0] / 0.282095f;
        sh[3][c] = kRadiance[c][1] / 0.488603f;
        sh[1][c] = kRadiance[c][2] / 0.488603f;
        sh[7][c] = kRadiance[c][3] / 1.092548f;
    }
    return sh;
}

// Irradiance from above and from below.
nlohmann::json hemisphere_color(float sign) {
    nlohmann::json color;
    for (const auto& [a, c] : kHemisphere) color.push_back(kPi * a + sign * 2 * kPi / 3 * c);
    return color;
}

Vec3 to_light_of(const Distant& light) {
    const float yaw = light.yaw_deg * float(kPi / 180), pitch = light.pitch_deg * float(kPi / 180);
    return {std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
}

nlohmann::json distant_lights() {
    nlohmann::json lights;
    for (const Distant& light : kDistant)
        lights.push_back({{"to_light", channels(to_light_of(light))}, {"color", channels(light.color)}});
    return lights;
}

std::string list_text(Vec3 v) {
    return "[" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + "]";
}

// At kPointMm.
std::string lamp_text(const std::string& kind, float intensity) {
    return "[[light]]\nkind = \"" + kind + "\"\nshadow = false\nposition_mm = " + list_text(kPointMm) +
           "\nintensity = " + std::to_string(intensity) + "\n";
}

std::string distant_text() {
    std::string text;
    for (const Distant& light : kDistant)
        text += "[[light]]\nshadow = false\nyaw_deg = " + std::to_string(light.yaw_deg) +
                "\npitch_deg = " + std::to_string(light.pitch_deg) + "\ncolor = " + list_text(light.color) +
                (&light == kDistant ? "\nkey = true\n" : "\n");
    return text;
}

std::string scene_text(const std::string& mesh, const std::string& rest) {
    return "background = [0.02, 0.02, 0.02]\ntone_map = \"none\"\n" + mesh +
           "[skin]\nprofile = \"openpbr_skin_5\"\nroughness = 0.45\n[material.skin]\nalbedo = [0.48, 0.19, "
           "0.11]\n"
           "[camera]\ntarget_mm = [0, 0, 0]\ndistance_mm = 150\nfov_deg = 7\n" +
           rest;
}

}  // namespace

void write_host_data(const std::filesystem::path& folder) {
    const auto radiance = [](Vec3 d, int c) {
        const float* k = kRadiance[c];
        return k[0] + k[1] * d.x + k[2] * d.y + k[3] * d.x * d.z;
    };
    ASSERT_TRUE(write_image(folder / "environment.hdr", panorama_of(radiance)));
    ASSERT_TRUE(write_image(folder / "bumps.png", bumps()));
    ASSERT_TRUE(write_image(folder / "thickness.png", thickness_ramp()));
    const nlohmann::json data = {
        {"to_light", {kToLight.x, kToLight.y, kToLight.z}},
        {"radiance_sh", radiance_sh()},
        {"sky", hemisphere_color(1)},
        {"ground", hemisphere_color(-1)},
        {"point", {{"position_mm", channels(kPointMm)}, {"intensity", kPointIntensity}}},
        {"spot",
         {{"target_mm", channels(kSpotAsideMm * card_side())},
          {"intensity", kSpotIntensity},
          {"inner_deg", kSpotInnerDeg},
          {"outer_deg", kSpotOuterDeg}}},
        {"distant", distant_lights()},
        {"sphere", json_of(sphere())},
        {"card", json_of(card())},
        {"behind",
         {{"to_light", channels(to_light_behind())},
          {"intensity", kBehindIntensity},
          {"max_mm", kThicknessMaxMm}}},
        {"sheet", json_of(sheet())},
        {"board", json_of(board())}};
    ASSERT_TRUE(write_text_file(folder / "scene.json", data.dump()));
}

void write_renderer_scenes(const std::filesystem::path& folder) {
    const auto hemisphere = [](Vec3 d, int c) { return kHemisphere[c][0] + kHemisphere[c][1] * d.y; };
    ASSERT_TRUE(write_image(folder / "hemisphere.hdr", panorama_of(hemisphere)));
    ASSERT_TRUE(write_text_file(folder / "sphere.obj", obj_of(sphere())));
    ASSERT_TRUE(write_text_file(folder / "sphere.mtl", "newmtl skin\n"));
    ASSERT_TRUE(write_text_file(folder / "card.obj", obj_of(card())));
    const std::string mesh = "[[mesh]]\nfile = \"sphere.obj\"\n", dark = "[environment]\nkind = \"none\"\n",
                      key = "[[light]]\nyaw_deg = -50\npitch_deg = 35\nintensity = 3.14159265\n",
                      point = lamp_text("point", kPointIntensity),
                      spot = lamp_text("spot", kSpotIntensity) +
                             "target_mm = " + list_text(kSpotAsideMm * card_side()) +
                             "\ninner_angle_deg = " + std::to_string(kSpotInnerDeg) +
                             "\nouter_angle_deg = " + std::to_string(kSpotOuterDeg) + "\n",
                      behind = "[[light]]\nshadow = false\nyaw_deg = " + std::to_string(kBehindYawDeg) +
                               "\npitch_deg = " + std::to_string(kBehindPitchDeg) +
                               "\nintensity = " + std::to_string(kBehindIntensity) + "\n",
                      none = "[[light]]\nintensity = 0\nshadow = false\n";
    const std::pair<const char*, std::string> scenes[] = {
        {"environment", scene_text(mesh, none + "[environment]\nfile = \"environment.hdr\"\n")},
        {"probe", scene_text(mesh, none + "[environment]\nfile = \"environment.hdr\"\n")},
        {"hemisphere", scene_text(mesh, none + "[environment]\nfile = \"hemisphere.hdr\"\n")},
        {"point", scene_text(mesh, dark + point)},
        {"spot", scene_text(mesh, dark + spot)},
        {"lights", scene_text(mesh, dark + distant_text() + point)},
        {"shadow",
         scene_text(mesh + "[[mesh]]\nfile = \"card.obj\"\ndefault_class = \"other\"\n", dark + key)},
        {"through", scene_text(mesh, dark + behind)},
        {"bumps", scene_text(mesh, dark + key + "shadow = false\n[maps]\nnormal = \"bumps.png\"\n")}};
    for (const auto& [name, text] : scenes)
        ASSERT_TRUE(write_text_file(folder / (std::string(name) + ".toml"), text));
}

Vec3 sphere_normal(int x, int y, int side) {
    const double per_pixel = 2 * std::tan(3.5 * kPi / 180) / side;
    const Vec3 way = normalize(
        Vec3{float((x + 0.5 - 0.5 * side) * per_pixel), float((0.5 * side - y - 0.5) * per_pixel), -1});
    // From the eye, at 150 mm, along `way` to the sphere; beside it, to where it passes.
    const float towards = -150 * way.z, beside2 = 150 * 150 - towards * towards;
    const float length_mm = towards - std::sqrt(std::max(kRadiusMm * kRadiusMm - beside2, 0.0f));
    return normalize(Vec3{0, 0, 150} + length_mm * way);
}

bool is_compared(const HostScene& scene, int x, int y, int side) {
    const Vec3 n = sphere_normal(x, y, side);
    const double from_edge_mm = kRadiusMm * dot(n, card_side()) - kCardEdgeMm;
    return dot(n, kToLight) >= scene.min_n_dot_l && std::abs(from_edge_mm) >= scene.skipped_edge_mm;
}

}  // namespace dermis
