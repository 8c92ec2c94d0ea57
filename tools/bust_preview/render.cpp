#include "render.h"

#include <embree3/rtcore.h>

#include <memory>
#include <numbers>

#include "dermis/base/parallel.h"
#include "dermis/image/colour.h"

namespace dermis::preview {

using namespace bust;

namespace {

constexpr int kKeyRays = 12, kSkyRays = 24;
constexpr double kPi = std::numbers::pi;

double random01(uint32_t& state) {
    state = state * 1664525u + 1013904223u;
    uint32_t v = state;
    v ^= v >> 15, v *= 0x2c1b3c6d, v ^= v >> 12;
    return (v >> 8) / 16777216.0;
}

class Rays {
  public:
    explicit Rays(const Surface& mesh) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
        RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* v = static_cast<float*>(
            rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.points.size()));
        auto* f = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
        for (const Point& p : mesh.points) *v++ = float(p.x), *v++ = float(p.y), *v++ = float(p.z);
        for (const auto& t : mesh.triangles)
            for (const int k : t) *f++ = unsigned(k);
        rtcCommitGeometry(g);
        rtcAttachGeometry(scene_, g);
        rtcReleaseGeometry(g);
        rtcCommitScene(scene_);
    }
    ~Rays() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    Rays(const Rays&) = delete;
    Rays& operator=(const Rays&) = delete;

    struct Hit {
        int triangle = -1;
        double distance = 0, u = 0, v = 0;
    };
    [[nodiscard]] Hit first(Point o, Point d) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit r = {};
        r.ray.org_x = float(o.x), r.ray.org_y = float(o.y), r.ray.org_z = float(o.z);
        r.ray.dir_x = float(d.x), r.ray.dir_y = float(d.y), r.ray.dir_z = float(d.z);
        r.ray.tfar = 1e9f, r.ray.mask = ~0u, r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &context, &r);
        if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
        return {int(r.hit.primID), r.ray.tfar, r.hit.u, r.hit.v};
    }
    [[nodiscard]] bool blocked(Point o, Point d) const { return first(o, d).triangle >= 0; }

  private:
    RTCDevice device_;
    RTCScene scene_;
};

struct Surfel {
    Point at, geometric, normal;
    double albedo[3] = {0.62, 0.47, 0.40};
    double roughness = 0.5;
    double lift_mm = 0.2;  ///< clears the mesh for rays that start here
};

double sample(const Image& image, double u, double v, int channel) {
    const double x = std::clamp(u * image.width - 0.5, 0.0, image.width - 1.001),
                 y = std::clamp(v * image.height - 0.5, 0.0, image.height - 1.001);
    const int x0 = int(x), y0 = int(y);
    const auto at = [&](int dx, int dy) { return double(image.at(x0 + dx, y0 + dy, channel)); };
    return mix(mix(at(0, 0), at(1, 0), x - x0), mix(at(0, 1), at(1, 1), x - x0), y - y0);
}

Surfel surfel(const Subject& s, const Rays::Hit& hit, Point at) {
    const auto& t = s.mesh.triangles[size_t(hit.triangle)];
    const auto blend = [&](auto value) {
        return value(size_t(t[0])) * (1 - hit.u - hit.v) + value(size_t(t[1])) * hit.u +
               value(size_t(t[2])) * hit.v;
    };
    Surfel out = {.at = at, .geometric = unit(blend([&](size_t k) { return s.normals[k]; })), .normal = {}};
    if (s.field) {
        out.at = s.field->project(at, 1);
        out.geometric = s.field->normal(out.at);
        out.lift_mm = 1.0;
    }
    out.normal = out.geometric;
    if (!s.skin) return out;
    const Mesh& mesh = s.skin->mesh;
    const double u = blend([&](size_t k) { return double(mesh.uvs[k].x); }),
                 v = blend([&](size_t k) { return double(mesh.uvs[k].y); });
    for (int k = 0; k < 3; ++k) out.albedo[k] = sample(s.skin->albedo, u, v, k);
    out.roughness = sample(s.skin->roughness, u, v, 0);
    Point tangent = blend([&](size_t k) {
        return Point{mesh.tangents[k].x, mesh.tangents[k].y, mesh.tangents[k].z};
    });
    const Point n = out.geometric;
    tangent = unit(tangent - n * dot(tangent, n));
    const auto slope = [&](int c) { return 2 * sample(s.skin->normal, u, v, c) - 1; };
    out.normal = unit(tangent * slope(0) + cross(n, tangent) * slope(1) + n * slope(2));
    return out;
}

struct Frame {
    Point toward, right, up, light, rim;
};

Frame frame_of(const View& view) {
    const double az = view.azimuth_deg * kPi / 180, el = view.elevation_deg * kPi / 180;
    Frame f;
    f.toward = {std::sin(az) * std::cos(el), std::sin(el), std::cos(az) * std::cos(el)};
    f.right = {std::cos(az), 0, -std::sin(az)};
    f.up = cross(f.toward, f.right);
    f.light = unit(view.to_light);
    f.rim = unit(f.toward * -0.5 - f.right * std::copysign(1.0, dot(f.light, f.right)) + Point{0, 0.3, 0});
    return f;
}

double sky_light(const Rays& rays, const Surfel& s, uint32_t& state) {
    const Point n = s.geometric, o = s.at + n * s.lift_mm;
    const Point tangent = unit(cross(std::abs(n.y) < 0.9 ? Point{0, 1, 0} : Point{1, 0, 0}, n)),
                other = cross(n, tangent);
    double sum = 0;
    for (int k = 0; k < kSkyRays; ++k) {
        const double r = std::sqrt((k + random01(state)) / kSkyRays), phi = 2 * kPi * random01(state);
        const Point l =
            tangent * (r * std::cos(phi)) + other * (r * std::sin(phi)) + n * std::sqrt(1 - r * r);
        if (!rays.blocked(o, l)) sum += (0.55 + 0.45 * l.y) / kSkyRays;
    }
    return sum;
}

void shade(const Rays& rays, const Frame& f, const Surfel& s, uint32_t& state, double (&c)[3]) {
    const Point o = s.at + s.geometric * s.lift_mm;
    double key = 0;
    for (int k = 0; k < kKeyRays; ++k) {
        const Point spread = {random01(state) - 0.5, random01(state) - 0.5, random01(state) - 0.5};
        if (!rays.blocked(o, unit(f.light + spread * 0.35))) key += 1.0 / kKeyRays;
    }
    const double sky = sky_light(rays, s, state), n_dot_l = dot(s.normal, f.light);
    const double back = std::max(0.0, dot(s.normal, f.rim)) * (rays.blocked(o, f.rim) ? 0.0 : 1.0);
    const double a2 = std::pow(s.roughness, 4),
                 n_dot_h = std::max(0.0, dot(s.normal, unit(f.light + f.toward)));
    const double fresnel = 1 + 8 * std::pow(1 - std::abs(dot(s.normal, f.toward)), 4);
    const double gloss = n_dot_l > 0 ? 0.018 * std::pow(n_dot_h, 2 / a2) / a2 * fresnel * key : 0;
    // Light from behind: how far to the other side towards the lamp, and whether the lamp is seen from there.
    double through_mm = 1e9;
    const double behind = std::max(0.0, -dot(s.geometric, f.light));
    if (behind > 0) {
        const Rays::Hit exit = rays.first(s.at - s.geometric * 0.2, f.light);
        if (exit.triangle >= 0 && !rays.blocked(s.at + f.light * (exit.distance + 0.5), f.light))
            through_mm = exit.distance;
    }
    constexpr double kWrap[3] = {0.22, 0.06, 0.02}, kReachMm[3] = {4.2, 1.3, 0.7};
    for (int k = 0; k < 3; ++k) {
        const double wrapped = std::max(0.0, (n_dot_l + kWrap[k]) / (1 + kWrap[k]));
        const double lit = wrapped * (n_dot_l < 0.1 ? std::max(key, 0.3 * key) : key);
        c[k] = s.albedo[k] * (1.15 * lit + 0.34 * sky + 0.35 * back +
                              1.6 * behind * std::exp(-through_mm / kReachMm[k])) +
               gloss;
    }
}

double tone(double v) {  // a filmic shoulder
    const double t = v * 0.62;
    return std::clamp(t * (2.51 * t + 0.03) / (t * (2.43 * t + 0.59) + 0.14), 0.0, 1.0);
}

}  // namespace

Image render(const Subject& subject, const View& view, int side) {
    const Rays rays(subject.mesh);
    const Frame f = frame_of(view);
    const Point eye = view.target + f.toward * 1200;
    Image image(side, side, 3, PixelFormat::u8, Encoding::srgb);
    const auto bytes = image.values<uint8_t>();
    parallel_for(size_t(side), 4, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (int x = 0; x < side; ++x) {
                uint32_t state = uint32_t(y) * 9781u + uint32_t(x) * 6271u + 1;
                const double s = view.width_mm / side;
                const Point at = view.target + f.right * ((x + 0.5 - side / 2.0) * s) -
                                 f.up * ((double(y) + 0.5 - side / 2.0) * s);
                const Point direction = unit(at - eye);
                const Rays::Hit hit = rays.first(eye, direction);
                double c[3] = {0.16, 0.17, 0.19};
                if (hit.triangle >= 0)
                    shade(rays, f, surfel(subject, hit, eye + direction * hit.distance), state, c);
                for (int k = 0; k < 3; ++k)
                    bytes[(y * size_t(side) + size_t(x)) * 3 + size_t(k)] =
                        uint8_t(255 * std::pow(tone(c[k]), 1 / 2.2) + 0.5);
            }
    });
    return image;
}

}  // namespace dermis::preview
