#include "dermis/view/background_walks.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>

#include "dermis/base/stop.h"
#include "dermis/render/linked_light.h"
#include "dermis/render/walked_scene.h"

namespace dermis::view {

struct BackgroundWalks::Job {
    std::string key, skin;  // walks_key() of the gain, and of the same skin whatever the gain
    std::atomic<bool> stop = false;
    std::future<void> done;  // last: waits for its task before the rest goes

    ~Job() { stop = true; }
};

namespace {

// An error is left to the drawing, which meets it again at once.
void walk(const Scene& scene, Gain gain, const std::atomic<bool>* stop) {
    const StopScope scope(stop);
    try {
        if (gain == Gain::map)
            (void)walk_scene_gains(scene);
        else if (LinkedLight::check(scene))
            (void)walk_scene_links(scene);
    } catch (const Stopped&) {
    }
}

}  // namespace

BackgroundWalks::BackgroundWalks() = default;
BackgroundWalks::~BackgroundWalks() = default;
BackgroundWalks::BackgroundWalks(BackgroundWalks&&) noexcept = default;
BackgroundWalks& BackgroundWalks::operator=(BackgroundWalks&&) noexcept = default;

bool BackgroundWalks::have(const Scene& scene, Gain gain) {
    if (gain != Gain::map && gain != Gain::links) return true;
    std::string key = walks_key(scene, gain), skin = walks_key(scene, Gain::none);
    if (std::ranges::find(made_, key) != made_.end()) return true;
    if (job_) {
        if (job_->skin != skin) job_->stop = true;
        return false;
    }
    job_ = std::make_unique<Job>();
    job_->key = std::move(key);
    job_->skin = std::move(skin);
    job_->done =
        std::async(std::launch::async, [scene, gain, stop = &job_->stop] { walk(scene, gain, stop); });
    return false;
}

bool BackgroundWalks::take() {
    if (!job_ || job_->done.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    job_->done.get();
    if (!job_->stop) made_.push_back(job_->key);
    job_.reset();
    return true;
}

void BackgroundWalks::wait() const {
    if (job_) job_->done.wait();
}

void BackgroundWalks::forget() {
    made_.clear();
    if (job_) job_->stop = true;
}

}  // namespace dermis::view
