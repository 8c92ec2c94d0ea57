#include "dermis/rays/guided_walk.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "dermis/base/angle.h"
#include "dermis/base/parallel.h"

namespace dermis::inline rays {
namespace {

// Chosen among 0.5, 0.75, 0.9 and 0.97 on a half-space and the head scan, jensen_skin1: 0.9 takes a quarter
// less time to one noise in green and blue than 0.75 and as long in red; beyond it red gets worse.
constexpr float kGuidedChance = 0.9f;
// Chosen among 1/3, .6, .8, .9 and .95 in balls of 6 to 40 mm, for OpenPBR's skins III and VI, gpu_gems_3 and
// jensen_skin1: beyond it little is left to gain, and the other channels have ever fewer walks of their own.
constexpr float kWidestLeads = 0.9f;
constexpr double kMostAlbedo = 0.99;
constexpr float Vec3::*kChannels[3] = {&Vec3::x, &Vec3::y, &Vec3::z};
constexpr double kLeastLength = 1.01, kMostLength = 100;
// A walk is guided up to this many collisions. In a medium that hardly absorbs, the weights of hundreds of
// guided steps would multiply and leave the light to a few rare paths.
constexpr int kGuidedCollisions = 64;

}  // namespace

double diffusion_length_in_paths(double albedo) {
    double low = kLeastLength, high = kMostLength;
    for (int i = 0; i < 60; ++i) {
        const double nu = std::sqrt(low * high);
        (albedo * nu / 2 * std::log((nu + 1) / (nu - 1)) > 1 ? low : high) = nu;
    }
    return low;
}

WalkGuide walk_guide(const ScatteringMedium& medium) {
    // Directions that the phase function hardly ever takes would waste the step.
    WalkGuide guide{.leads = Vec3{1, 1, 1} * (1.0f / 3),
                    .chance = kGuidedChance * float(1 - std::abs(medium.g))};
    for (int c = 0; c < 3; ++c) {
        // Over hundreds of collisions the weights of the steps multiply, so that a few paths would have most
        // of the light.
        if (reduced_albedo(medium, c) > kMostAlbedo) guide.chance = 0;
        // The decay is that of the reduced medium, counted in mean free paths of this one.
        const double nu =
            std::max(kLeastLength, diffusion_length_in_paths(reduced_albedo(medium, c)) *
                                       sigma_t_per_mm(medium, c) / reduced_sigma_t_per_mm(medium, c));
        guide.diffusion_length.*kChannels[c] = float(nu);
        guide.log_ratio.*kChannels[c] = float(std::log((nu + 1) / (nu - 1)));
    }
    return guide;
}

WalkGuide walk_guide_of_pairs(const ScatteringMedium& medium) {
    WalkGuide guide = walk_guide(medium);
    // Unguided walks have hundreds of collisions, over which the densities of the channels drift apart.
    if (guide.chance == 0) return guide;
    const auto length_mm = [&](int c) {
        return double(guide.diffusion_length.*kChannels[c]) / sigma_t_per_mm(medium, c);
    };
    int widest = 0;
    for (int c = 1; c < 3; ++c)
        if (length_mm(c) > length_mm(widest)) widest = c;
    guide.leads = Vec3{1, 1, 1} * ((1 - kWidestLeads) / 2);
    guide.leads.*kChannels[widest] = kWidestLeads;
    return guide;
}

GuidedWalk::GuidedWalk(const WalkMedium& medium, const WalkGuide& guide, Vec3 p_mm, Vec3 n_out,
                       Vec3 direction, float lead, Pcg32 random)
    : medium_(medium),
      guide_(guide),
      random_(random),
      n_out_(n_out),
      hero_(lead < guide.leads.x                   ? 0
            : lead < guide.leads.x + guide.leads.y ? 1
                                                   : 2),
      path_{.throughput = {1, 1, 1}, .p_mm = p_mm, .direction = direction},
      led_by_(guide.leads * (1 - kPlainWalks)),
      plain_by_(guide.leads * kPlainWalks),
      draw_chance_(random_.next_1d() < kPlainWalks ? 0 : guide.chance),
      guided_chance_(guide.chance) {}

void GuidedWalk::draw() {
    float Vec3::*const channel = kChannels[hero_];
    const float nu = guide_.diffusion_length.*channel;
    const bool guided = random_.next_1d() < draw_chance_;
    phase_ = 0;
    if (turned_) {
        const Vec2 place = random_.next_2d();
        const Vec3 before = path_.direction;
        if (guided) {
            // The inverse of the integral of 1 / (nu - w) from -1.
            const float w =
                std::clamp(nu - (nu + 1) * std::exp(-guide_.log_ratio.*channel * place.x), -1.0f, 1.0f);
            const float sine = std::sqrt(1 - w * w), azimuth_rad = 2 * kPi * place.y;
            path_.direction =
                frame_of(n_out_).to_world({sine * std::cos(azimuth_rad), sine * std::sin(azimuth_rad), w});
        } else {
            path_.direction = sample_henyey_greenstein(place, before, medium_.g);
        }
        phase_ = 4 * kPi * henyey_greenstein(dot(before, path_.direction), medium_.g);
    }
    const float stretch = guided ? 1 - dot(path_.direction, n_out_) / nu : 1;
    distance_mm_ = sample_exponential_mm(random_.next_1d(), medium_.sigma_t_per_mm.*channel * stretch);
}

// The throughput times what the step carries over the density with which it is drawn.
void GuidedWalk::weigh(float distance_mm, bool collides) {
    const float cosine_out = dot(path_.direction, n_out_);
    Vec3 carried, drawn, plain;  // the densities if this channel led a guided, a plain walk
    float density = 0;
    for (float Vec3::*c : kChannels) {
        const float sigma_t = medium_.sigma_t_per_mm.*c, nu = guide_.diffusion_length.*c;
        const float passing = std::exp(-sigma_t * distance_mm);
        carried.*c = passing * (collides ? medium_.sigma_s_per_mm.*c : 1.0f);
        plain.*c = passing * (collides ? sigma_t : 1.0f);
        drawn.*c = plain.*c;
        if (guided_chance_ > 0) {
            const float stretched = sigma_t * (1 - cosine_out / nu);
            // Densities of the direction are over the phase function, which the path carries too.
            const float towards = phase_ > 0 ? 2 / (guide_.log_ratio.*c * (nu - cosine_out) * phase_) : 1.0f;
            const float guided = towards * std::exp(-stretched * distance_mm) * (collides ? stretched : 1.0f);
            drawn.*c += guided_chance_ * (guided - plain.*c);
        }
        density += led_by_.*c * drawn.*c + plain_by_.*c * plain.*c;
    }
    const float over = density > 0 ? 1 / density : 0;
    path_.throughput = path_.throughput * carried * over;
    led_by_ = led_by_ * drawn * over;
    plain_by_ = plain_by_ * plain * over;
}

bool GuidedWalk::take(const std::optional<BoundaryHit>& hit) {
    if (hit && dot(hit->n_out, path_.direction) <= 0) return ends({.lost = true});
    const float distance_mm = hit ? hit->distance_mm : distance_mm_;
    weigh(distance_mm, !hit.has_value());
    path_.p_mm += path_.direction * distance_mm;
    turned_ = !hit.has_value();
    if (turned_) {
        if (++path_.collisions == kGuidedCollisions) draw_chance_ = guided_chance_ = 0;
        if (path_.collisions >= kMostCollisions || !survives_roulette(path_.throughput, random_))
            return ends({});
        return true;
    }
    const auto reflected = reflected_at(*hit, path_.direction, medium_.eta, random_);
    if (reflected) path_.direction = *reflected;
    return reflected.has_value();
}

HalfSpaceAlbedo guided_half_space_albedo(const ScatteringMedium& medium, int walks, uint32_t seed) {
    const WalkMedium prepared = walk_medium(medium);
    const WalkGuide guide = walk_guide(medium);
    std::vector<Vec3> returned(static_cast<size_t>(walks));
    parallel_for(returned.size(), 256, [&](size_t begin, size_t end) {
        const Vec3 n{0, 0, 1};
        for (size_t i = begin; i < end; ++i) {
            Pcg32 random(seed, uint32_t(i));
            const Vec3 start = sample_entry_direction(n, prepared.eta, random);
            const float lead = golden_1d(seed, uint32_t(i));
            returned[i] = guided_walk(prepared, guide, HalfSpace{}, {}, n, start, lead, random).throughput;
        }
    });
    return mean_of(returned);
}

}  // namespace dermis::inline rays
