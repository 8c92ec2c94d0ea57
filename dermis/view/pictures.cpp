#include "dermis/view/pictures.h"

#include "dermis/base/progress.h"

namespace dermis::view {
namespace {

constexpr const char* kShaderTopic = "shader ";

size_t drawn_sides(const Model& model, const gpu::Texture* reference) {
    return model.compares() && !reference ? 2 : 1;
}

}  // namespace

bool Pictures::follow_shaders() {
    if (!shaders_.poll() || !scene_.is_there()) return false;
    scene_.stage().forget_shaders();
    shaders_unproven_ = true;
    return true;
}

void Pictures::report_shaders(Notices& notices) const {
    const std::vector<Notice> all = notices.all();
    for (const Notice& notice : all)
        if (notice.topic.starts_with(kShaderTopic)) notices.clear(notice.topic);
    for (const auto& [name, message] : shaders_.errors())
        notices.report_error(kShaderTopic + name, message + kLastGood);
}

void Pictures::take_times(Notices& notices) {
    if (!scene_.is_there()) return;
    for (size_t side = 0; side < 2; ++side) {
        const Result<bool> taken = scene_.stage().take_times(side);
        if (!taken) notices.report_error("times", taken.error().message);
        if (taken && *taken && side == 0) times_.add(scene_.stage().picture(0).timings);
    }
}

void Pictures::refresh(Model& model, const gpu::Texture* reference, PictureSize size, double now_s) {
    drew_ = false;
    if (!scene_.is_there()) return;
    scene_.follow_skin();
    scene_.stage().take_walks();
    if (const Result<void> moved = scene_.follow_motion(); !moved)
        model.notices.report_error("motion", moved.error().message);
    for (size_t side = 0; side < drawn_sides(model, reference); ++side) {
        const Result<bool> drew = scene_.stage().refresh(model, side, size, now_s);
        const std::string topic = "picture " + std::to_string(side);
        if (!drew) {
            // Shaders that compile but do not fit together are taken back; any other error is shown.
            if (shaders_unproven_ && shaders_.take_back(drew.error().message))
                scene_.stage().forget_shaders();
            else
                model.notices.report_error(topic, drew.error().message);
            continue;
        }
        if (!*drew) continue;
        model.notices.clear(topic);
        if (shaders_unproven_) shaders_.confirm();
        shaders_unproven_ = false;
        drew_ = true;
    }
    report_walks(drawn_sides(model, reference), model.notices, now_s);
}

void Pictures::report_walks(size_t sides, Notices& notices, double now_s) const {
    const Stage& stage = scene_.stage();
    const bool lacks = stage.lacks_walks(0) || (sides == 2 && stage.lacks_walks(1));
    if (!stage.is_walking() || !lacks) return notices.clear("walks");
    const std::string progress = current_progress();
    notices.inform("walks", (progress.empty() ? "walks" : progress) + "; until then gain=curvature", now_s);
}

ShownPictures Pictures::shown(const Model& model, const gpu::Texture* reference) const {
    ShownPictures pictures = {.reference = reference};
    if (!scene_.is_there()) return pictures;
    pictures.a = scene_.stage().image(0);
    if (drawn_sides(model, reference) == 2) pictures.b = scene_.stage().image(1);
    return pictures;
}

bool Pictures::are_final(const Model& model, const gpu::Texture* reference) const {
    if (!scene_.is_there() || drew_) return false;
    return scene_.stage().is_final(0) && (drawn_sides(model, reference) == 1 || scene_.stage().is_final(1));
}

void Pictures::describe(PanelFacts& facts) const {
    if (scene_.is_there() && scene_.stage().picture(0).width > 0)
        times_.describe(scene_.stage().picture(0), facts);
}

}  // namespace dermis::view
