// Clips of glTF 2.0, section 3.11: channels join a sampler's keys to a property of a node.

#include "dermis/mesh/gltf/animation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "dermis/mesh/gltf/accessor.h"

namespace dermis::inline mesh::gltf {
namespace {

constexpr size_t kMaxTargets = 4096;

size_t count_targets(const JsonView& mesh) {
    return mesh["primitives"].size() == 0 ? 0 : mesh["primitives"][size_t{0}]["targets"].size();
}

class ChannelReader {
  public:
    ChannelReader(Document& document, const JsonView& clip, const JsonView& channel)
        : document_(document), clip_(clip), channel_(channel), target_(channel["target"]) {}

    /// Nothing for a channel without a node, which the specification ignores, and after an error.
    std::optional<Channel> run() {
        Channel found;
        found.path = target_["path"].text("");
        if (found.path == "pointer")
            return target_.fail(
                       "uses KHR_animation_pointer, which is not supported; export the file without"),
                   std::nullopt;
        if (!target_["node"].exists() || target_.failed()) return std::nullopt;
        found.node = target_["node"].integer(0);
        found.keys.width = width_of(found);
        if (target_.failed()) return std::nullopt;
        read_keys(found);
        return target_.failed() ? std::nullopt : std::optional(std::move(found));
    }

    /// When the last key is.
    double length_s() {
        const std::vector<float> times = read_times(sampler());
        return times.empty() ? 0 : times.back();
    }

  private:
    JsonView sampler() { return clip_["samplers"][size_t(channel_["sampler"].integer(0))]; }

    size_t width_of(const Channel& found) {
        const JsonView node = document_.view()["nodes"][size_t(found.node)];
        if (node.failed()) return 0;
        if (found.path == "weights") {
            const JsonView mesh = document_.view()["meshes"][size_t(node["mesh"].integer(0))];
            const size_t count = mesh.failed() ? 0 : count_targets(mesh);
            if (!node["mesh"].exists() || count == 0) target_.fail("its node has no mesh with morph targets");
            if (count > kMaxTargets) mesh.fail(fmt::format("more than {} morph targets", kMaxTargets));
            return count;
        }
        if (node["matrix"].exists())
            target_.fail(
                fmt::format("nodes[{}] has a matrix; a node that moves needs translation, rotation and scale",
                            found.node));
        if (found.path == "rotation") return 4;
        if (found.path == "translation" || found.path == "scale") return 3;
        return target_["path"].fail("must be translation, rotation, scale or weights"), 0;
    }

    std::vector<float> read_times(const JsonView& source) {
        const JsonView input = source["input"];
        if (!input.exists()) source.fail("has no input");
        const uint64_t accessor = input.integer(0);
        if (source.failed()) return {};
        std::vector<float> times = read_floats(document_, accessor, 1);
        if (source.failed()) return {};
        if (times.empty()) return input.fail("has no keys"), std::vector<float>{};
        for (size_t i = 0; i < times.size(); ++i) {
            if (!std::isfinite(times[i]))
                return input.fail(fmt::format("the time of key {} must be finite", i)), std::vector<float>{};
            if (i > 0 && times[i] < times[i - 1])
                return input.fail(fmt::format("the times go back at key {} ({} s after {} s)", i, times[i],
                                              times[i - 1])),
                       std::vector<float>{};
        }
        return times;
    }

    void read_keys(Channel& found) {
        const JsonView source = sampler();
        if (source.failed()) return;
        Keys& keys = found.keys;
        const std::string kind = source["interpolation"].text("LINEAR");
        if (kind != "STEP" && kind != "LINEAR" && kind != "CUBICSPLINE")
            return source["interpolation"].fail("must be STEP, LINEAR or CUBICSPLINE");
        keys.interpolation = kind == "STEP"     ? Interpolation::step
                             : kind == "LINEAR" ? Interpolation::linear
                                                : Interpolation::cubic_spline;
        keys.times_s = read_times(source);
        const JsonView output = source["output"];
        if (!output.exists()) source.fail("has no output");
        const uint64_t accessor = output.integer(0);
        if (source.failed()) return;
        keys.values = read_floats(document_, accessor, found.path == "weights" ? 1 : keys.width);
        if (source.failed()) return;
        const size_t needed =
            keys.times_s.size() * keys.width * (keys.interpolation == Interpolation::cubic_spline ? 3 : 1);
        if (keys.values.size() != needed)
            return output.fail(fmt::format("has {} numbers; {} keys need {}", keys.values.size(),
                                           keys.times_s.size(), needed));
        if (!std::ranges::all_of(keys.values, [](float v) { return std::isfinite(v); }))
            output.fail("must be finite");
    }

    Document& document_;
    JsonView clip_, channel_, target_;
};

double length_of(Document& document, const JsonView& clip) {
    double length_s = 0;
    const JsonView channels = clip["channels"];
    for (size_t i = 0; i < channels.size() && !clip.failed(); ++i)
        length_s = std::max(length_s, ChannelReader(document, clip, channels[i]).length_s());
    return length_s;
}

template <size_t N>
std::array<double, N> array_of(const std::vector<double>& values) {
    std::array<double, N> array{};
    std::copy_n(values.begin(), N, array.begin());
    return array;
}

void set_property(NodePose& pose, const std::string& path, const std::vector<double>& value) {
    if (path == "translation") pose.translation = array_of<3>(value);
    if (path == "scale") pose.scale = array_of<3>(value);
    if (path == "rotation") pose.rotation = array_of<4>(value);
    if (path == "weights") pose.weights.assign(value.begin(), value.end());
}

double time_in_clip(Document& document, const JsonView& clip, const Pose& pose) {
    if (!pose.loop) return pose.time_s;
    const double length_s = length_of(document, clip);
    if (!(length_s > 0)) return 0;
    const double rest_s = std::fmod(pose.time_s, length_s);
    return rest_s < 0 ? rest_s + length_s : rest_s;
}

}  // namespace

std::string clip_name(const JsonView& clip, size_t index) {
    const std::string name = clip["name"].text("");
    return name.empty() ? numbered_name(index) : name;
}

std::vector<Channel> read_channels(Document& document, const JsonView& clip) {
    const JsonView channels = clip["channels"];
    std::vector<Channel> all;
    std::set<std::pair<uint64_t, std::string>> known;
    for (size_t i = 0; i < channels.size() && !clip.failed(); ++i) {
        auto found = ChannelReader(document, clip, channels[i]).run();
        if (!found) continue;
        if (!known.emplace(found->node, found->path).second)
            channels[i].fail(
                fmt::format("the {} of nodes[{}] is animated twice in one clip", found->path, found->node));
        all.push_back(std::move(*found));
    }
    return all;
}

NodePoses sample_clip(Document& document, const Pose& pose) {
    const JsonView clips = document.view()["animations"];
    NodePoses nodes;
    size_t chosen = clips.size();
    for (size_t i = clips.size(); i-- > 0 && !pose.clip.empty();)
        if (clip_name(clips[i], i) == pose.clip || numbered_name(i) == pose.clip) chosen = i;
    if (chosen == clips.size() || clips.failed()) return nodes;
    const JsonView clip = clips[chosen];
    const double time_s = time_in_clip(document, clip, pose);
    for (const Channel& channel : read_channels(document, clip))
        set_property(nodes[channel.node], channel.path,
                     sample(channel.keys, time_s, channel.path == "rotation"));
    return nodes;
}

std::vector<std::string> target_names(const JsonView& mesh) {
    const size_t count = count_targets(mesh);
    const nlohmann::json* extras = mesh["extras"].json();  // of any type
    std::vector<std::string> names;
    if (count > kMaxTargets) return mesh.fail(fmt::format("more than {} morph targets", kMaxTargets)), names;
    const nlohmann::json given =
        extras && extras->is_object() ? extras->value("targetNames", nlohmann::json()) : nlohmann::json();
    for (size_t i = 0; i < count; ++i) {
        const bool named = given.is_array() && i < given.size() && given[i].is_string();
        names.push_back(named ? given[i].get<std::string>() : numbered_name(i));
    }
    return names;
}

void choose_weights(const Pose& pose, const JsonView& mesh, std::vector<float>& weights) {
    if (pose.morph.empty()) return;
    const std::vector<std::string> names = target_names(mesh);
    weights.resize(names.size());
    for (size_t i = 0; i < names.size(); ++i)
        for (const std::string& key : {numbered_name(i), names[i]})
            if (const auto chosen = pose.morph.find(key); chosen != pose.morph.end())
                weights[i] = chosen->second;
}

Motion read_motion(Document& document) {
    Motion motion;
    const JsonView clips = document.view()["animations"], meshes = document.view()["meshes"],
                   skins = document.view()["skins"];
    for (size_t i = 0; i < clips.size() && !clips.failed(); ++i) {
        ClipInfo clip = {.name = clip_name(clips[i], i), .channels = clips[i]["channels"].size()};
        clip.length_s = length_of(document, clips[i]);
        // A still needs no clip, so that a broken one does not keep the file from being read.
        if (const auto error = std::exchange(document.messages.error, {}))
            document.messages.warnings.push_back(error->message + "; clip '" + clip.name + "' does not play");
        motion.clips.push_back(std::move(clip));
    }
    std::set<std::string> known;
    for (size_t i = 0; i < meshes.size() && !meshes.failed(); ++i)
        for (std::string& name : target_names(meshes[i]))
            if (known.insert(name).second) motion.targets.push_back(std::move(name));
    motion.skins = skins.size();
    for (size_t i = 0; i < skins.size() && !skins.failed(); ++i) motion.joints += skins[i]["joints"].size();
    return motion;
}

}  // namespace dermis::inline mesh::gltf
