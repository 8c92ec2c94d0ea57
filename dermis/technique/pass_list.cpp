#include "dermis/technique/pass_list.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "dermis/base/text.h"

namespace dermis::inline technique {
namespace {

std::string_view kind_name(PassKind kind) {
    switch (kind) {
        case PassKind::fullscreen:
            return "fullscreen";
        case PassKind::compute:
            return "compute";
        case PassKind::geometry_screen:
            return "geometry, screen";
        case PassKind::geometry_uv_atlas:
            return "geometry, uv atlas";
        case PassKind::geometry_light:
            return "geometry, light";
        case PassKind::resolve:
            return "resolve";
        case PassKind::generate_mips:
            return "generate mips";
        case PassKind::copy:
            return "copy";
    }
    return "";
}

std::string size_text(const ImageSize& size) {
    if (size.width > 0) return std::to_string(size.width) + "x" + std::to_string(size.height);
    return size.frame_scale == 1 ? "frame" : "frame x " + to_text(size.frame_scale);
}

// Checks the passes in order and keeps the names of the images written so far.
class Checker {
  public:
    Checker(const PassList& list, const std::vector<std::string>& inputs)
        : list_(list), inputs_(inputs.begin(), inputs.end()) {
        for (const ImageDeclaration& image : list.images)
            if (image.persistent) written_.insert(image.name);
        if (list.seams) inputs_.insert({"seam_map", "chart_map"});
        if (list.diffused_normals)
            inputs_.insert(kDiffusedNormalsTextures.begin(), kDiffusedNormalsTextures.end());
    }

    std::vector<std::string> run() {
        check_names();
        for (const Pass& pass : list_.passes) check_pass(pass);
        return std::move(problems_);
    }

  private:
    void report(const Pass& pass, const std::string& what) {
        problems_.push_back("pass '" + pass.name + "' " + what);
    }

    void check_names() {
        std::set<std::string> names;
        for (const ImageDeclaration& image : list_.images) {
            if (!names.insert(image.name).second)
                problems_.push_back("image '" + image.name + "' is declared twice");
            if (image.samples != 1 && image.samples != 4)
                problems_.push_back("image '" + image.name + "' has " + std::to_string(image.samples) +
                                    " samples; 1 or 4");
        }
        std::set<std::string> passes;
        for (const Pass& pass : list_.passes)
            if (!passes.insert(pass.name).second)
                problems_.push_back("pass '" + pass.name + "' stands twice");
    }

    void check_pass(const Pass& pass) {
        const bool transfer = pass.kind == PassKind::resolve || pass.kind == PassKind::generate_mips ||
                              pass.kind == PassKind::copy;
        const bool depth_only = pass.depth && pass.colors.empty();
        const bool clears_only = pass.kind == PassKind::fullscreen;
        if (pass.shader.empty() && !transfer && !depth_only && !clears_only) report(pass, "has no shader");
        if (transfer && pass.reads.empty()) report(pass, "has nothing to read");
        const bool writes_nothing =
            pass.colors.empty() && !pass.depth && pass.storage.empty() && pass.buffers.empty();
        if (writes_nothing && pass.kind != PassKind::generate_mips) report(pass, "writes nothing");
        check_reads(pass);
        check_targets(pass);
    }

    void check_reads(const Pass& pass) {
        for (const ImageRead& read : pass.reads) {
            if (inputs_.contains(read.image)) continue;
            if (!list_.find_image(read.image))
                report(pass, "reads '" + read.image + "', which nothing supplies");
            else if (!written_.contains(read.image))
                report(pass, "reads '" + read.image + "' before anything wrote it");
        }
    }

    void check_targets(const Pass& pass) {
        std::vector<std::pair<std::string, LoadOp>> targets;
        for (const ColorTarget& color : pass.colors) targets.emplace_back(color.image, color.load);
        if (pass.depth) targets.emplace_back(pass.depth->image, pass.depth->load);
        for (const ImageRead& write : pass.storage) targets.emplace_back(write.image, LoadOp::discard);
        const ImageDeclaration* first = nullptr;
        for (const auto& [name, load] : targets) {
            const ImageDeclaration* image = list_.find_image(name);
            if (!image) {
                report(pass, "writes '" + name + "', which is not declared");
                continue;
            }
            if (load == LoadOp::load && !written_.contains(name))
                report(pass, "loads '" + name + "' before anything wrote it");
            const std::string& wanted = name;  // clang 14 cannot capture `name` itself
            const bool only_tested =
                pass.depth && name == pass.depth->image && load == LoadOp::load && !pass.depth->write;
            if (!only_tested &&
                std::ranges::any_of(pass.reads, [&](const ImageRead& read) { return read.image == wanted; }))
                report(pass, "reads and writes '" + name + "'");
            if (!first) first = image;
            if (!(image->size == first->size)) report(pass, "has targets of different sizes");
            if (image->samples != first->samples) report(pass, "has targets of different sample counts");
            written_.insert(name);
        }
    }

    const PassList& list_;
    std::set<std::string> inputs_, written_;
    std::vector<std::string> problems_;
};

}  // namespace

std::string profile_name(const std::string& name, int profile) {
    return profile == 0 ? name : name + "@" + std::to_string(profile);
}

std::string_view format_name(ImageFormat format) {
    static constexpr std::string_view kNames[] = {"r8",    "rg8",     "rgba8", "rgb10a2", "rgba16",  "r16f",
                                                  "rg16f", "rgba16f", "r32f",  "rgba32f", "depth32f"};
    return kNames[size_t(format)];
}

size_t bytes_per_texel(ImageFormat format) {
    static constexpr size_t kBytes[] = {1, 2, 4, 4, 8, 2, 4, 8, 4, 16, 4};
    return kBytes[size_t(format)];
}

TexelSize size_in_frame(const ImageSize& size, int frame_width, int frame_height) {
    if (size.width > 0 && size.height > 0) return {size.width, size.height};
    const auto scaled = [&](int side) {
        return int(std::max(1L, std::lround(float(side) * size.frame_scale)));
    };
    return {scaled(frame_width), scaled(frame_height)};
}

uint64_t bytes_in_frame(const ImageDeclaration& image, int frame_width, int frame_height) {
    TexelSize level = size_in_frame(image.size, frame_width, frame_height);
    uint64_t texels = 0;
    for (int mip = 0; image.mips == 0 || mip < image.mips; ++mip) {
        texels += uint64_t(level.width) * uint64_t(level.height);
        if (level.width == 1 && level.height == 1) break;
        level = {std::max(level.width / 2, 1), std::max(level.height / 2, 1)};
    }
    return texels * bytes_per_texel(image.format) * uint64_t(image.samples);
}

const ImageDeclaration* PassList::find_image(std::string_view name) const {
    const auto found = std::ranges::find(images, name, &ImageDeclaration::name);
    return found == images.end() ? nullptr : &*found;
}

std::vector<std::string> problems(const PassList& list, const std::vector<std::string>& inputs) {
    return Checker(list, inputs).run();
}

std::string describe(const PassList& list) {
    std::string text;
    if (list.seams) text += "input seam_map, chart_map  " + std::to_string(list.seams->size) + "\n";
    if (list.diffused_normals)
        text += "input diffused_normals_red, diffused_normals_green, diffused_normals_uneven  " +
                std::to_string(list.diffused_normals->size) + "\n";
    for (const ImageDeclaration& image : list.images) {
        text += "image " + image.name + "  " + std::string(format_name(image.format)) + "  " +
                size_text(image.size);
        if (image.samples > 1) text += "  " + std::to_string(image.samples) + " samples";
        if (image.mips != 1) text += "  mips";
        if (image.persistent) text += "  persistent";
        text += "\n";
    }
    for (const Pass& pass : list.passes) {
        text += "pass " + pass.name + "  [" + std::string(kind_name(pass.kind)) + "]  " + pass.shader;
        for (const ImageRead& read : pass.reads)
            text += (&read == &pass.reads.front() ? "  reads " : ", ") + read.image;
        std::vector<std::string> targets;
        for (const ColorTarget& color : pass.colors) targets.push_back(color.image);
        if (pass.depth) targets.push_back(pass.depth->image + (pass.depth->write ? "" : " (test only)"));
        for (const ImageRead& write : pass.storage) targets.push_back(write.image);
        for (const ImageRead& buffer : pass.buffers) targets.push_back(buffer.image);
        text += "  writes " + join(targets, ", ") + "\n";
    }
    return text;
}

}  // namespace dermis::inline technique
