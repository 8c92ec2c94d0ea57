// bust_preview OUT.png [view] [size] [--obj FILE SCALE]: clay render of the built-in bust's distance field,
// or of an OBJ to hold beside it. One key light from the upper left with an area, a sky, a rim; per-pixel
// normals of the field.

#include <embree3/rtcore.h>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "dermis/base/parallel.h"
#include "dermis/bust/bust.h"
#include "dermis/bust/field.h"
#include "dermis/bust/head_mesh.h"
#include "dermis/image/io.h"

using namespace dermis;
using namespace dermis::bust;

struct View {
    double azimuth_deg, elevation_deg;
    Point target;
    double width_mm;
    Point light;
};
static const std::map<std::string, View> kViews = {
    {"whole", {25, 2, {0, -40, 0}, 400, {-0.45, 0.65, 0.75}}},
    {"wholeback", {150, 5, {0, -40, 0}, 400, {0.6, 0.6, -0.6}}},
    {"front", {0, 0, {0, -10, 0}, 330, {-0.55, 0.65, 0.75}}},
    {"quarter", {38, 4, {0, -10, 0}, 330, {-0.35, 0.65, 0.75}}},
    {"profile", {90, 0, {0, -10, 5}, 330, {0.35, 0.6, 0.85}}},
    {"back", {160, 8, {0, -20, 0}, 330, {0.6, 0.6, -0.6}}},
    {"ear", {75, 5, {75, 4, 0}, 95, {0.5, 0.6, 0.7}}},
    {"earback", {150, 5, {75, 4, 0}, 95, {0.7, 0.6, -0.4}}},
    {"earfront", {15, 5, {75, 4, 0}, 95, {0.3, 0.6, 0.7}}},
    {"eye", {12, 2, {31, 22, 90}, 75, {-0.55, 0.65, 0.75}}},
    {"eyeside", {60, 2, {31, 22, 90}, 75, {0.15, 0.75, 0.75}}},
    {"mouth", {0, 0, {0, -40, 105}, 90, {-0.55, 0.65, 0.75}}},
    {"mouth34", {40, 0, {0, -40, 105}, 90, {-0.35, 0.65, 0.75}}},
    {"nose", {0, 0, {0, 0, 110}, 90, {-0.55, 0.65, 0.75}}},
    {"nose34", {45, -8, {0, 0, 110}, 90, {-0.35, 0.65, 0.75}}},
    {"nosebelow", {15, -40, {0, 0, 110}, 90, {-0.35, 0.65, 0.75}}},
    {"face", {0, 0, {0, 0, 90}, 190, {-0.55, 0.65, 0.75}}},
    {"face34", {35, 0, {20, 0, 80}, 190, {-0.35, 0.65, 0.75}}},
    {"below", {20, -35, {0, -20, 40}, 280, {-0.35, 0.65, 0.75}}},
    {"top", {20, 50, {0, 20, 0}, 280, {-0.35, 0.65, 0.75}}},
};

static Surface read_obj(const char* path, double scale) {
    Surface s;
    std::ifstream file(path);
    Point low = {1e9, 1e9, 1e9}, high = low * -1;
    for (std::string line; std::getline(file, line);) {
        std::istringstream in(line);
        std::string key;
        in >> key;
        if (key == "v") {
            Point p;
            in >> p.x >> p.y >> p.z;
            p = p * scale;
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            s.points.push_back(p);
        } else if (key == "f") {
            std::vector<int> f;
            for (std::string t; in >> t;) f.push_back(std::stoi(t) - 1);
            for (size_t k = 2; k < f.size(); ++k) s.triangles.push_back({f[0], f[k - 1], f[k]});
        }
    }
    // Crown to the crown's height, front to the nose tip's.
    for (Point& p : s.points) p = p - Point{(low.x + high.x) / 2, high.y - 135, high.z - 130};
    return s;
}

// What a close-up sees, meshed at its own scale, in a fraction of the time of the whole head.
static Surface crop(const BustField& field, const View& view) {
    const double r = view.width_mm * 0.6;
    const Point half = {r, r, r};
    Surface s = extract_surface([&](Point p) { return field.distance_mm(p); },
                                {view.target - half, view.target + half}, view.width_mm / 130);
    parallel_for(s.points.size(), 256, [&](size_t b, size_t e) {
        for (size_t i = b; i < e; ++i) s.points[i] = field.project(s.points[i], 2);
    });
    return s;
}

static double random01(uint32_t& state) {
    state = state * 1664525u + 1013904223u;
    uint32_t v = state;
    v ^= v >> 15, v *= 0x2c1b3c6d, v ^= v >> 12;
    return (v >> 8) / 16777216.0;
}

int main(int argc, char** argv) {
    if (argc < 3) return std::puts("bust_preview SIZE VIEW... [--obj FILE SCALE]"), 1;
    const int size = std::atoi(argv[1]);
    const bool scan = argc > 5 && !std::strcmp(argv[argc - 3], "--obj");
    const bool skin = !std::strcmp(argv[2], "skin");
    const std::vector<std::string> views(argv + (skin ? 3 : 2), argv + (scan ? argc - 3 : argc));
    Bust bust;
    if (skin) {
        BustParams params;
        if (const char* tone = std::getenv("TONE")) params.tone = std::atof(tone);
        Result<Bust> made = build_bust(params, kBustMapSide);
        if (!made) return std::puts(made.error().message.c_str()), 1;
        bust = std::move(*made);
        bust.albedo = to_linear_float(bust.albedo);
        if (std::getenv("MAPS")) {
            (void)write_image("albedo_map.png", convert(bust.albedo, PixelFormat::u8, Encoding::srgb));
            (void)write_image("normal_map.png", bust.normal);
            (void)write_image("roughness_map.png", bust.roughness);
        }
    }
    const BustField field{BustParams{}};
    const auto t0 = std::chrono::steady_clock::now();
    Surface mesh = scan                  ? read_obj(argv[argc - 2], std::atof(argv[argc - 1]))
                   : skin                ? Surface{}
                   : std::getenv("CROP") ? crop(field, kViews.at(views[0]))
                                         : make_head_surface(field);
    if (skin) {
        for (const Vec3& p : bust.mesh.positions_mm) mesh.points.push_back({p.x, p.y, p.z});
        for (size_t i = 0; i < bust.mesh.indices.size(); i += 3)
            mesh.triangles.push_back(
                {int(bust.mesh.indices[i]), int(bust.mesh.indices[i + 1]), int(bust.mesh.indices[i + 2])});
    }
    std::vector<Point> normals(mesh.points.size());
    if (scan)
        for (const auto& t : mesh.triangles) {
            const Point n =
                cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]);
            for (int k : t) normals[k] = normals[k] + n;
        }
    const auto t1 = std::chrono::steady_clock::now();
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                          RTC_FORMAT_FLOAT3, 12, mesh.points.size()));
    auto* f = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                             RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
    parallel_for(mesh.points.size(), 1024, [&](size_t b, size_t e) {
        for (size_t i = b; i < e; ++i) {
            const Point p = mesh.points[i];
            if (skin)
                normals[i] = {bust.mesh.normals[i].x, bust.mesh.normals[i].y, bust.mesh.normals[i].z};
            else if (!scan)
                normals[i] = field.normal(p);
            v[3 * i] = float(p.x), v[3 * i + 1] = float(p.y), v[3 * i + 2] = float(p.z);
        }
    });
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) f[3 * i + k] = unsigned(mesh.triangles[i][k]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcCommitScene(scene);
    const auto t2 = std::chrono::steady_clock::now();

    for (const std::string& name : views) {
        const View view = kViews.at(name);
        const double az = view.azimuth_deg * M_PI / 180, el = view.elevation_deg * M_PI / 180;
        const Point toward = {std::sin(az) * std::cos(el), std::sin(el), std::cos(az) * std::cos(el)};
        const Point right = {std::cos(az), 0, -std::sin(az)}, up = cross(toward, right);
        const double distance = 1200;
        const Point eye = view.target + toward * distance;
        std::vector<unsigned char> pixels(size_t(size) * size * 3);
        const auto occluded = [&](Point o, Point d) {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            RTCRay ray = {};
            ray.org_x = float(o.x), ray.org_y = float(o.y), ray.org_z = float(o.z);
            ray.dir_x = float(d.x), ray.dir_y = float(d.y), ray.dir_z = float(d.z);
            ray.tnear = 0.3f, ray.tfar = 1e4f, ray.mask = ~0u;
            rtcOccluded1(scene, &context, &ray);
            return ray.tfar < 0;
        };
        parallel_for(size, 4, [&](size_t begin, size_t end) {
            for (size_t y = begin; y < end; ++y)
                for (int x = 0; x < size; ++x) {
                    uint32_t rng = uint32_t(y * 9781 + x * 6271 + 1);
                    const double s = view.width_mm / size;
                    const Point at = view.target + right * ((x + 0.5 - size / 2.0) * s) -
                                     up * ((y + 0.5 - size / 2.0) * s);
                    const Point dir = unit(at - eye);
                    RTCIntersectContext context;
                    rtcInitIntersectContext(&context);
                    RTCRayHit hit = {};
                    hit.ray.org_x = float(eye.x), hit.ray.org_y = float(eye.y), hit.ray.org_z = float(eye.z);
                    hit.ray.dir_x = float(dir.x), hit.ray.dir_y = float(dir.y), hit.ray.dir_z = float(dir.z);
                    hit.ray.tfar = 1e9f, hit.ray.mask = ~0u, hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
                    rtcIntersect1(scene, &context, &hit);
                    double c[3] = {0.16, 0.17, 0.19};
                    if (hit.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
                        Point p = eye + dir * hit.ray.tfar, n;
                        const auto& t = mesh.triangles[hit.hit.primID];
                        n = unit(normals[t[1]] * hit.hit.u + normals[t[2]] * hit.hit.v +
                                 normals[t[0]] * (1 - hit.hit.u - hit.hit.v));
                        const Point o = p + n * 0.2;
                        double albedo[3] = {0.62, 0.47, 0.40}, rough = 0.5;
                        if (skin) {
                            const auto blend2 = [&](auto get) {
                                return get(t[1]) * double(hit.hit.u) + get(t[2]) * double(hit.hit.v) +
                                       get(t[0]) * double(1 - hit.hit.u - hit.hit.v);
                            };
                            const double u = blend2([&](int k) { return double(bust.mesh.uvs[k].x); }) *
                                                 kBustMapSide -
                                             0.5,
                                         w = blend2([&](int k) { return double(bust.mesh.uvs[k].y); }) *
                                                 kBustMapSide -
                                             0.5;
                            const auto sample = [&](const Image& im, int channel) {
                                const int x0 = int(u), y0 = int(w);
                                const double fx = u - x0, fy = w - y0;
                                return mix(
                                    mix(double(im.at(x0, y0, channel)), im.at(x0 + 1, y0, channel), fx),
                                    mix(double(im.at(x0, y0 + 1, channel)), im.at(x0 + 1, y0 + 1, channel),
                                        fx),
                                    fy);
                            };
                            for (int k = 0; k < 3; ++k) albedo[k] = sample(bust.albedo, k);
                            rough = sample(bust.roughness, 0);
                            Point tan = blend2([&](int k) {
                                const Vec4 q = bust.mesh.tangents[k];
                                return Point{q.x, q.y, q.z};
                            });
                            tan = unit(tan - n * dot(tan, n));
                            n = unit(tan * (2 * sample(bust.normal, 0) - 1) +
                                     cross(n, tan) * (2 * sample(bust.normal, 1) - 1) +
                                     n * (2 * sample(bust.normal, 2) - 1));
                        }
                        const Point l0 = unit(view.light),
                                    rim = unit(toward * -0.5 -
                                               right * std::copysign(1.0, dot(view.light, right)) +
                                               Point{0, 0.3, 0});
                        double key = 0, sky = 0;
                        Point tangent = unit(cross(std::abs(n.y) < 0.9 ? Point{0, 1, 0} : Point{1, 0, 0}, n)),
                              bitangent = cross(n, tangent);
                        constexpr int kKey = 4, kSky = 9;
                        for (int k = 0; k < kKey; ++k) {
                            const Point l = unit(
                                l0 +
                                Point{random01(rng) - 0.5, random01(rng) - 0.5, random01(rng) - 0.5} * 0.35);
                            if (!occluded(o, l)) key += 1.0 / kKey;
                        }
                        for (int k = 0; k < kSky; ++k) {
                            const double r = std::sqrt((k + random01(rng)) / kSky),
                                         phi = 2 * M_PI * random01(rng);
                            const Point l = tangent * (r * std::cos(phi)) + bitangent * (r * std::sin(phi)) +
                                            n * std::sqrt(1 - r * r);
                            if (!occluded(o, l)) sky += (0.55 + 0.45 * l.y) / kSky;
                        }
                        const double nl = dot(n, l0);
                        const double back = std::max(0.0, dot(n, rim)) * (occluded(o, rim) ? 0.0 : 1.0);
                        const Point h = unit(l0 - dir);
                        const double spec =
                            nl > 0 ? 0.9 * std::pow(std::max(0.0, dot(n, h)), 2 / std::pow(rough, 4)) /
                                         std::pow(rough, 4) * 0.02 *
                                         (1 + 8 * std::pow(1 - std::abs(dot(n, dir)), 4)) * key
                                   : 0;
                        const double wrap[3] = {0.22, 0.06, 0.02};
                        for (int k = 0; k < 3; ++k) {
                            const double diffuse = std::max(0.0, (nl + wrap[k]) / (1 + wrap[k])) *
                                                   std::max(key, nl < 0.1 ? 0.3 * key : key);
                            c[k] = albedo[k] * (1.15 * diffuse + 0.34 * sky + 0.35 * back) + spec;
                        }
                    }
                    for (int k = 0; k < 3; ++k) {
                        const double t = c[k] * 0.62;
                        const double tone = t * (2.51 * t + 0.03) / (t * (2.43 * t + 0.59) + 0.14);
                        pixels[(y * size + x) * 3 + k] =
                            static_cast<unsigned char>(255 * std::pow(std::clamp(tone, 0.0, 1.0), 1 / 2.2));
                    }
                }
        });
        const auto t3 = std::chrono::steady_clock::now();
        const auto ms = [](auto a, auto b) {
            return std::chrono::duration<double, std::milli>(b - a).count();
        };
        std::printf("%zu triangles; extract %.0f, project %.0f, render %.0f ms\n", mesh.triangles.size(),
                    ms(t0, t1), ms(t1, t2), ms(t2, t3));
        Image out(size, size, 3, PixelFormat::u8, Encoding::srgb);
        std::memcpy(out.bytes.data(), pixels.data(), pixels.size());
        if (const auto written = write_image(name + ".png", out); !written)
            return std::puts(written.error().message.c_str()), 1;
    }
}
