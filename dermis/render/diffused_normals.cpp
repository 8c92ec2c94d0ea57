// Each Gaussian is summed over a level of the atlas whose texels are nearly as wide as it is: a sum over a
// grid of steps h is the integral of a Gaussian to 2 exp(-2 pi^2 sigma^2 / h^2). Texels vary in width, so
// that h is not above 0.8 sigma for the typical one.

#include "dermis/render/diffused_normals.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>
#include <unordered_map>

#include "dermis/base/cache.h"
#include "dermis/base/file.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/image/dilate.h"
#include "dermis/technique/diffused_normals.h"

namespace dermis {
namespace {

constexpr int kLevels = 5, kGutterTexels = 16, kProfileSteps = 2048;
constexpr float kWidestStep = 0.8f;  // of a Gaussian's standard deviation
constexpr float kReach = 3.2f;       // the same
// Cosine of the normals of two walls that no way through air may join. The head scan's share under its key
// light, by the sum of the shadowed light over its texels with this kernel: without the rule .69, at 0 .83,
// at this .85.
constexpr float kSameWall = 0.7f;

// Of red and green: the integral of the profile, and of the profile times the normal; of red the profile
// times the products of the normal's parts.
struct Sums {
    std::array<float, 2> weight = {};
    std::array<Vec3, 2> normal = {};
    Vec3 squares = {}, mixed = {};  // xx, yy, zz; yz, xz, xy
};
// The Gaussians of one level: R of red and green over the squared distance, and how far they reach.
struct LevelProfile {
    std::vector<std::array<float, 2>> steps;
    float reach_mm = 0;

    [[nodiscard]] std::array<float, 2> at(float squared_mm2) const {
        const float place = squared_mm2 / (reach_mm * reach_mm) * kProfileSteps;
        const auto i = size_t(place);
        const float part = place - float(i);
        return {std::lerp(steps[i][0], steps[i + 1][0], part), std::lerp(steps[i][1], steps[i + 1][1], part)};
    }
};

std::array<double, 3> totals(const GaussianSum& profile) {
    std::array<double, 3> total = {};
    for (const GaussianTerm& term : profile.terms)
        for (size_t c = 0; c < 3; ++c) total[c] += term.weight[c];
    for (double& sum : total) sum = sum > 0 ? sum : 1;
    return total;
}

int level_of(double variance_mm2, float texel_mm) {
    const double steps = kWidestStep * std::sqrt(variance_mm2) / std::max(double(texel_mm), 1e-6);
    return std::clamp(int(std::floor(std::log2(std::max(steps, 1.0)))), 0, kLevels - 1);
}

LevelProfile level_profile(const GaussianSum& profile, float finest_mm2, int level, float texel_mm) {
    std::vector<GaussianTerm> terms;
    for (const GaussianTerm& term : profile.terms)
        if (term.variance_mm2 >= finest_mm2 && level_of(term.variance_mm2, texel_mm) == level)
            terms.push_back(term);
    LevelProfile made;
    if (terms.empty()) return made;
    for (const GaussianTerm& term : terms)
        made.reach_mm = std::max(made.reach_mm, kReach * float(std::sqrt(term.variance_mm2)));
    const std::array<double, 3> total = totals(profile);
    for (int i = 0; i <= kProfileSteps + 1; ++i) {
        const double squared_mm2 = double(i) / kProfileSteps * made.reach_mm * made.reach_mm;
        std::array<float, 2> r = {};
        for (const GaussianTerm& term : terms)
            for (size_t c = 0; c < 2; ++c)
                r[c] += float(term.weight[c] / total[c] / (2 * std::numbers::pi * term.variance_mm2) *
                              std::exp(-0.5 * squared_mm2 / term.variance_mm2));
        made.steps.push_back(r);
    }
    return made;
}

// Texels in the order of the cubes that they lie in.
class Cubes {
  public:
    Cubes(std::vector<SkinTexel> texels, float side_mm) : texels_(std::move(texels)), side_mm_(side_mm) {
        const auto key = [&](const SkinTexel& texel) { return key_of(cube_of(texel.p_mm)); };
        std::ranges::sort(texels_, [&](const SkinTexel& a, const SkinTexel& b) {
            const uint64_t ka = key(a), kb = key(b);
            return ka != kb ? ka < kb : a.index < b.index;
        });
        for (size_t begin = 0, end = 0; begin < texels_.size(); begin = end) {
            while (end < texels_.size() && key(texels_[end]) == key(texels_[begin])) ++end;
            index_.emplace(key(texels_[begin]), cubes_.size());
            cubes_.push_back(std::span(texels_).subspan(begin, end - begin));
        }
    }
    [[nodiscard]] const std::vector<std::span<const SkinTexel>>& all() const { return cubes_; }
    // Within `cubes` of the one in each direction.
    [[nodiscard]] std::vector<std::span<const SkinTexel>> around(Vec3 p_mm, int cubes) const {
        std::vector<std::span<const SkinTexel>> found;
        const std::array<int, 3> at = cube_of(p_mm);
        for (int x = -cubes; x <= cubes; ++x)
            for (int y = -cubes; y <= cubes; ++y)
                for (int z = -cubes; z <= cubes; ++z)
                    if (const auto i = index_.find(key_of({at[0] + x, at[1] + y, at[2] + z}));
                        i != index_.end())
                        found.push_back(cubes_[i->second]);
        return found;
    }

  private:
    [[nodiscard]] std::array<int, 3> cube_of(Vec3 p_mm) const {
        const auto part = [&](float x) { return int(std::floor(std::clamp(x / side_mm_, -1e6f, 1e6f))); };
        return {part(p_mm.x), part(p_mm.y), part(p_mm.z)};
    }
    static uint64_t key_of(std::array<int, 3> cube) {
        const auto part = [](int x) { return uint64_t(x + (1 << 20)) & 0x1FFFFF; };
        return part(cube[0]) << 42 | part(cube[1]) << 21 | part(cube[2]);
    }
    std::vector<SkinTexel> texels_;
    float side_mm_;
    std::vector<std::span<const SkinTexel>> cubes_;
    std::unordered_map<uint64_t, size_t> index_;
};

void add(Sums& sums, const SkinTexel& from, const SkinTexel& to, const LevelProfile& profile) {
    const Vec3 way_mm = from.p_mm - to.p_mm;
    const float squared_mm2 = dot(way_mm, way_mm);
    if (squared_mm2 >= profile.reach_mm * profile.reach_mm || from.area_mm2 <= 0) return;
    const bool through_air = dot(way_mm, to.n_geometry) > 0 && dot(way_mm, from.n_geometry) < 0;
    if (through_air && dot(to.n_geometry, from.n_geometry) < kSameWall) return;
    const std::array<float, 2> r = profile.at(squared_mm2);
    const Vec3 n = from.n;
    for (size_t c = 0; c < 2; ++c) {
        sums.weight[c] += from.area_mm2 * r[c];
        sums.normal[c] += n * (from.area_mm2 * r[c]);
    }
    sums.squares += n * n * (from.area_mm2 * r[0]);
    sums.mixed += Vec3{n.y * n.z, n.x * n.z, n.x * n.y} * (from.area_mm2 * r[0]);
}

// Adds what the texels of one level give to the sums of each of `skin`.
void gather(const SkinTexels& skin, const SkinTexels& level, const LevelProfile& profile,
            std::span<Sums> sums) {
    const float side_mm = 0.5f * profile.reach_mm;
    std::vector<SkinTexel> numbered = skin.texels;
    for (size_t i = 0; i < numbered.size(); ++i) numbered[i].index = uint32_t(i);
    const Cubes targets(std::move(numbered), side_mm), sources(level.texels, side_mm);
    parallel_for(targets.all().size(), 16, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const auto near = sources.around(targets.all()[i].front().p_mm, 2);
            for (const SkinTexel& to : targets.all()[i])
                for (const auto& cube : near)
                    for (const SkinTexel& from : cube) add(sums[to.index], from, to, profile);
        }
    });
}

// The shader's frame: techniques/preintegrated/diffused_normals.glsl.
struct TangentFrame {
    Vec3 x, z;
    explicit TangentFrame(Vec3 n) {
        const float a = 1 / std::max(1 + n.y, 1e-4f), b = -n.x * n.z * a;
        x = {1 - n.x * n.x * a, -n.x, b};
        z = {b, -n.z, 1 - n.z * n.z * a};
    }
};

// p and q of the spread around its mean.
Vec2 unevenness(const Sums& sums, Vec3 mean) {
    const Vec3 s = sums.squares * (1 / sums.weight[0]), m = sums.mixed * (1 / sums.weight[0]);
    const TangentFrame frame(normalize(mean));
    const auto spread = [&](Vec3 a, Vec3 b) {
        return s.x * a.x * b.x + s.y * a.y * b.y + s.z * a.z * b.z + m.x * (a.y * b.z + a.z * b.y) +
               m.y * (a.x * b.z + a.z * b.x) + m.z * (a.x * b.y + a.y * b.x) - dot(mean, a) * dot(mean, b);
    };
    const float xx = spread(frame.x, frame.x), zz = spread(frame.z, frame.z), xz = spread(frame.x, frame.z);
    const float half = std::max(0.5f * (xx + zz), 1e-7f);
    return {std::clamp(0.5f * (xx - zz) / half, -1.0f, 1.0f), std::clamp(xz / half, -1.0f, 1.0f)};
}

uint16_t encoded(float x) {
    return uint16_t(std::clamp(x * 0.5f + 0.5f, 0.0f, 1.0f) * 65535 + 0.5f);
}

// Such that the pixel's mix by own_weights, whose sum the profile's integral over a plane is, is the mean
// over this surface: more of the wide Gaussians where there is more skin around the point.
Vec3 stored_mean(const Sums& sums, size_t c, Vec3 n_own, float own_weight) {
    if (own_weight > 1 - 1e-4f || sums.weight[c] <= 0) return n_own;
    const Vec3 mean = (n_own * own_weight + sums.normal[c]) * (1 / (own_weight + sums.weight[c]));
    return (mean - n_own * own_weight) * (1 / (1 - own_weight));
}

DiffusedNormals bake(const SkinTexelReader& reader, const GaussianSum& profile,
                     const DiffusedNormalsRequest& request) {
    const SkinTexels skin = reader.read(request.size);
    const float texel_mm = typical_texel_mm(skin);
    std::vector<Sums> sums_of(skin.texels.size());
    for (int level = 0; level < kLevels; ++level) {
        const LevelProfile part = level_profile(profile, request.finest_variance_mm2, level, texel_mm);
        if (part.steps.empty()) continue;
        gather(skin, reader.read(std::max(request.size >> level, 1)), part, sums_of);
    }
    const Vec3 own = own_normal_weights(profile, request);
    Image red(request.size, request.size, 4), green(request.size, request.size, 4);
    parallel_for(skin.texels.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const SkinTexel& texel = skin.texels[i];
            const Sums& sums = sums_of[i];
            const Vec2 uneven =
                sums.weight[0] > 0 ? unevenness(sums, sums.normal[0] * (1 / sums.weight[0])) : Vec2{};
            const Vec3 r = stored_mean(sums, 0, texel.n, own.x), g = stored_mean(sums, 1, texel.n, own.y);
            const Vec4 values[] = {{r.x, r.y, r.z, uneven.x}, {g.x, g.y, g.z, uneven.y}};
            std::memcpy(&red.floats()[4 * size_t(texel.index)], &values[0], sizeof values[0]);
            std::memcpy(&green.floats()[4 * size_t(texel.index)], &values[1], sizeof values[1]);
        }
    });
    DiffusedNormals made{.size = request.size, .red = {}, .green = {}};
    for (const auto& [image, texels] : {std::pair{&red, &made.red}, std::pair{&green, &made.green}}) {
        dilate(*image, skin.coverage, kGutterTexels);
        texels->resize(image->pixel_count());
        for (size_t i = 0; i < texels->size(); ++i)
            for (size_t c = 0; c < 4; ++c) (*texels)[i][c] = encoded(image->floats()[4 * i + c]);
    }
    return made;
}

Result<std::string> content_hash(const Scene& scene, const GaussianSum& profile,
                                 const DiffusedNormalsRequest& request) {
    Hasher hasher;
    hasher.add("diffused normals 3").add(request.size).add(request.finest_variance_mm2);
    for (const GaussianTerm& term : profile.terms)
        hasher.add(std::as_bytes(std::span(&term.variance_mm2, 1)))
            .add(std::as_bytes(std::span(term.weight)));
    for (const SceneObject& object : scene.objects) {
        const Mesh& mesh = object.mesh;
        hasher.add(std::as_bytes(std::span(mesh.positions_mm))).add(std::as_bytes(std::span(mesh.normals)));
        hasher.add(std::as_bytes(std::span(mesh.tangents))).add(std::as_bytes(std::span(mesh.uvs)));
        hasher.add(std::as_bytes(std::span(mesh.indices))).add(std::as_bytes(std::span(object.classes)));
        for (const Submesh& submesh : mesh.submeshes)
            hasher.add(submesh.first_index).add(submesh.index_count).add(submesh.material);
        for (const Material& material : mesh.materials) {
            const ImageSource& map = material.normal_map;
            hasher.add(material.normal_space).add(material.normal_scale).add(material.dilate_texels);
            hasher.add(map.wrap_u).add(map.wrap_v).add(std::span(map.encoded)).add(std::span(map.pixels));
            if (!map.encoded.empty() || !map.pixels.empty() || map.name.empty()) continue;
            const Result<std::vector<std::byte>> file = read_file(map.name);
            if (!file) return file.error();
            hasher.add(std::span(*file));
        }
    }
    return hasher.hex();
}

}  // namespace

Result<DiffusedNormals> bake_diffused_normals(const Scene& scene, const GaussianSum& profile,
                                              const DiffusedNormalsRequest& request) {
    const Result<std::string> hash = content_hash(scene, profile, request);
    if (!hash) return hash.error();
    const size_t texels = size_t(request.size) * size_t(request.size);
    const size_t bytes = texels * sizeof(DiffusedNormals::Texel);
    const Result<std::vector<std::byte>> stored =
        cached("diffused_normals", *hash, 2 * bytes, [&]() -> Result<std::vector<std::byte>> {
            const Result<SkinTexelReader> reader = SkinTexelReader::create(scene);
            if (!reader) return reader.error();
            const DiffusedNormals made = bake(*reader, profile, request);
            std::vector<std::byte> both(2 * bytes);
            std::memcpy(both.data(), made.red.data(), bytes);
            std::memcpy(both.data() + bytes, made.green.data(), bytes);
            return both;
        });
    if (!stored) return stored.error();
    DiffusedNormals normals{.size = request.size,
                            .red = std::vector<DiffusedNormals::Texel>(texels),
                            .green = std::vector<DiffusedNormals::Texel>(texels)};
    std::memcpy(normals.red.data(), stored->data(), bytes);
    std::memcpy(normals.green.data(), stored->data() + bytes, bytes);
    return normals;
}

}  // namespace dermis
