#include "dermis/render/profile_passes.h"

#include <algorithm>

namespace dermis::inline render {
namespace {

class Renamed {
  public:
    Renamed(const PassList& list, int profile, std::span<const std::string> tables)
        : list_(list), profile_(profile), tables_(tables) {}

    void append_to(PassList& all) const {
        for (ImageDeclaration image : list_.images) {
            image.name = profile_name(image.name, profile_);
            all.images.push_back(std::move(image));
        }
        for (const Pass& pass : list_.passes) all.passes.push_back(renamed(pass));
    }

  private:
    [[nodiscard]] std::string own(const std::string& image) const {
        const bool is_table = std::ranges::find(tables_, image) != tables_.end();
        const bool is_baked = list_.diffused_normals && std::ranges::find(kDiffusedNormalsTextures, image) !=
                                                            kDiffusedNormalsTextures.end();
        return list_.find_image(image) || is_table || is_baked ? profile_name(image, profile_) : image;
    }

    void read_own(Pass& pass, const std::string& texture) const {
        if (std::ranges::find(pass.reads, texture, &ImageRead::texture) == pass.reads.end())
            pass.reads.emplace_back(texture, profile_name(texture, profile_));
    }

    [[nodiscard]] Pass renamed(Pass pass) const {
        pass.profile = profile_;
        const auto on_picture = [](const ColorTarget& color) { return color.image == "radiance"; };
        pass.only_profile = std::ranges::any_of(pass.colors, on_picture);
        if (profile_ == 0) return pass;
        pass.name += ", profile " + std::to_string(profile_ + 1);
        for (ImageRead& read : pass.reads) read.image = own(read.image);
        for (ColorTarget& color : pass.colors) color.image = own(color.image);
        for (ImageRead& written : pass.storage) written.image = own(written.image);
        if (pass.depth) pass.depth->image = own(pass.depth->image);
        if (pass.shader.empty()) return pass;
        for (const std::string& table : tables_) read_own(pass, table);
        if (list_.diffused_normals)
            for (const char* texture : kDiffusedNormalsTextures) read_own(pass, texture);
        return pass;
    }

    const PassList& list_;
    int profile_;
    std::span<const std::string> tables_;
};

}  // namespace

PassList join_profiles(std::span<const PassList> lists, std::span<const std::string> tables) {
    PassList all = lists.front();
    if (lists.size() == 1) return all;
    all.images.clear(), all.passes.clear();
    for (size_t i = 0; i < lists.size(); ++i) {
        Renamed(lists[i], int(i), tables).append_to(all);
        if (lists[i].seams && all.seams)
            all.seams->width_texels = std::max(all.seams->width_texels, lists[i].seams->width_texels);
    }
    return all;
}

}  // namespace dermis::inline render
