#pragma once
// The user's choices: the scene, the techniques and their settings, what is shown. Plain data; panels,
// keys and scripts change it, the stage draws it.

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dermis/render/catalog.h"
#include "dermis/scene/scene.h"

namespace dermis::view {

/// One side of a comparison. Every technique keeps its settings while others are shown.
class TechniqueChoice {
  public:
    explicit TechniqueChoice(const Technique& technique) : technique_(&technique) {}

    [[nodiscard]] const Technique& technique() const { return *technique_; }
    void choose(const Technique& technique) { technique_ = &technique; }
    [[nodiscard]] ParameterValues& values();

  private:
    const Technique* technique_;
    std::map<std::string, ParameterValues> values_;
};

enum class Compare { off, wipe, side_by_side };

/// A line over the picture. One a topic: a later one replaces it.
struct Notice {
    std::string topic, text;
    bool is_error = false;
    double until_s = 0;  ///< errors stay until their topic is cleared
};

class Notices {
  public:
    void inform(std::string topic, std::string text, double now_s);
    void report_error(std::string topic, std::string text);
    void clear(const std::string& topic);
    void expire(double now_s);
    void dismiss() { all_.clear(); }
    [[nodiscard]] const std::vector<Notice>& all() const { return all_; }

  private:
    std::vector<Notice> all_;
};

/// Warnings about the scene and its picture, each once, until the user has read it.
class Warnings {
  public:
    void add(const std::vector<std::string>& warnings);
    /// Removes one of unread(); it does not come back before forget().
    void read(size_t index);
    void read_all();
    /// Before the same scene is loaded again: drops warnings that the user has not read yet.
    void begin_again() { unread_.clear(); }
    /// Before another scene is loaded: drops all warnings.
    void forget() { unread_.clear(), read_.clear(); }
    [[nodiscard]] const std::vector<std::string>& unread() const { return unread_; }

  private:
    std::vector<std::string> unread_, read_;
};

/// The field in which a path is typed.
struct OpenField {
    std::string text;
    bool is_fresh = true;      ///< takes the keyboard with the next frame
    bool is_untouched = true;  ///< its cursor is not at the end yet
};

struct Model {
    std::string scene_path;  ///< as opened: a file, a name, builtin:NAME
    std::vector<SceneWord>
        loading_words;       ///< --scene keys of is_loading_key(); the scene is read again when they change
    Scene* scene = nullptr;  ///< lives in the stage; null until the first one is loaded
    Catalog catalog;         ///< what may be chosen
    std::array<TechniqueChoice, 2> choices;
    std::string view = "final";
    int tone = 0;               ///< 0: as the maps are; 1 to 6: OpenPBR's skins
    bool playing = false;       ///< the time of scene->motion goes on
    std::string target_filter;  ///< part of the names of the morph targets that the panel lists
    Compare compare = Compare::off;
    float split = 0.5f;          ///< of the picture's width
    std::string reference_path;  ///< a picture that is shown on the right side instead of a technique
    bool reference_is_of_another_view = false;
    std::vector<std::string> recent;
    std::optional<OpenField> open_field;
    bool show_panels = true, show_help = false, vsync = true;
    float user_scale = 1;  ///< of the interface, on top of the display's
    Notices notices;
    Warnings warnings;

    [[nodiscard]] bool compares() const { return compare != Compare::off; }
};

/// Everything a picture depends on, as text: two equal keys are one picture. `choice` is 0 or 1.
[[nodiscard]] std::string picture_key(Model& model, size_t choice);

/// The next (or, with -1, the last) of a list of names, from the last to the first.
[[nodiscard]] std::string neighbour(const std::vector<std::string>& names, const std::string& name, int step);

}  // namespace dermis::view
