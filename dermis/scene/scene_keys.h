#pragma once
// One row for every key of the scene file: the row is what parses the key, checks it and documents it.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/scene/scene_description.h"

namespace dermis::inline scene {

enum class KeyKind { number, integer, toggle, text, file, choice, vector, color };

/// Numbers (and the components of vectors and colours) lie in a closed range. `default_text` is empty where
/// a key has none.
struct KeyInfo {
    std::string name, unit, doc;
    KeyKind kind = KeyKind::number;
    double min = 0, max = 1;
    std::vector<std::string> choices;
    std::string default_text;
    /// Of the root and [skin]: also on a loaded scene, as all of light, environment, camera.
    bool changeable = false;
    ImageSource Material::*needs = nullptr;  ///< a map without which the key has no effect
};

/// A value that passed its row's checks. A choice is its index.
struct KeyValue {
    double numbers[3] = {};
    int integer = 0;
    std::string text, full_name;  ///< full_name: "maps.albedo"
    int line = 0;                 ///< 0: not from a file
};

template <class Target>
struct Key {
    KeyInfo info;
    std::function<void(Target&, const KeyValue&)> set;
    /// False where the target has no value for it; empty where the row cannot be read back.
    std::function<bool(const Target&, KeyValue&)> get;
};

/// Text of numbers, toggles and choices for `default_text`.
[[nodiscard]] std::string key_text(const KeyInfo& info, const KeyValue& value);

/// A subject's parameter as a key of the file.
[[nodiscard]] KeyInfo key_info(const Parameter& parameter);

/// Collects {member, name, unit, min, max, doc}; defaults come from a default-constructed Target. A member
/// may be optional: then it has no default and tells whether the key was given.
template <class Target>
class KeyTable {
  public:
    template <class Member>
    KeyTable& number(Member Target::*member, KeyInfo info) {
        info.kind = KeyKind::number;
        return add(
            std::move(info),
            [member](Target& t, const KeyValue& v) {
                using Number = std::conditional_t<std::is_same_v<Member, double>, double, float>;
                t.*member = Number(v.numbers[0]);
            },
            [member](const Target& t, KeyValue& v) { return read(t.*member, v.numbers[0]); });
    }
    template <class Member>
    KeyTable& integer(Member Target::*member, KeyInfo info) {
        info.kind = KeyKind::integer;
        return add(
            std::move(info), [member](Target& t, const KeyValue& v) { t.*member = v.integer; },
            [member](const Target& t, KeyValue& v) { return read(t.*member, v.integer); });
    }
    template <class Member>
    KeyTable& toggle(Member Target::*member, KeyInfo info) {
        info.kind = KeyKind::toggle;
        return add(
            std::move(info), [member](Target& t, const KeyValue& v) { t.*member = v.integer != 0; },
            [member](const Target& t, KeyValue& v) { return read(t.*member, v.integer); });
    }
    template <class Enum, class Member>
    KeyTable& choice(Member Target::*member, KeyInfo info) {
        info.kind = KeyKind::choice;
        return add(
            std::move(info), [member](Target& t, const KeyValue& v) { t.*member = Enum(v.integer); },
            [member](const Target& t, KeyValue& v) { return read(t.*member, v.integer); });
    }
    template <class Member>
    KeyTable& vector(Member Target::*member, KeyInfo info, KeyKind kind = KeyKind::vector) {
        info.kind = kind;
        return add(
            std::move(info),
            [member](Target& t, const KeyValue& v) {
                t.*member = Vec3{float(v.numbers[0]), float(v.numbers[1]), float(v.numbers[2])};
            },
            [member](const Target& t, KeyValue& v) { return read(t.*member, v); });
    }
    template <class Member>
    KeyTable& color(Member Target::*member, KeyInfo info) {
        return vector(member, std::move(info), KeyKind::color);
    }
    KeyTable& text(std::string Target::*member, KeyInfo info) {
        info.kind = KeyKind::text;
        return add(
            std::move(info), [member](Target& t, const KeyValue& v) { t.*member = v.text; },
            [member](const Target& t, KeyValue& v) { return !(v.text = t.*member).empty(); });
    }
    KeyTable& file(NamedFile Target::*member, KeyInfo info) {
        info.kind = KeyKind::file;
        return add(
            std::move(info),
            [member](Target& t, const KeyValue& v) {
                t.*member = {.text = v.text, .key = v.full_name, .line = v.line};
            },
            [member](const Target& t, KeyValue& v) { return !(v.text = (t.*member).text).empty(); });
    }

    /// A member of each material that the section is about: such a row is all that the key needs here.
    template <class Member>
    KeyTable& of_material(Member Material::*member, KeyInfo info) {
        info.kind = std::is_same_v<Member, Vec3>          ? KeyKind::color
                    : std::is_same_v<Member, std::string> ? KeyKind::text
                    : std::is_enum_v<Member>              ? KeyKind::choice
                    : std::is_integral_v<Member>          ? KeyKind::integer
                                                          : KeyKind::number;
        const auto set = [member, name = info.name](Target& t, const KeyValue& v) {
            t.changes[name] = [member, v](Material& material) {
                if constexpr (std::is_same_v<Member, std::string>)
                    material.*member = v.text;
                else if constexpr (std::is_same_v<Member, Vec3>)
                    material.*member = {float(v.numbers[0]), float(v.numbers[1]), float(v.numbers[2])};
                else
                    material.*member =
                        std::is_same_v<Member, float> ? Member(v.numbers[0]) : Member(v.integer);
            };
        };
        keys_.push_back({std::move(info), set, {}});
        return *this;
    }
    KeyTable& map(ImageSource Material::*member, KeyInfo info) {
        info.kind = KeyKind::file;
        const auto set = [member, name = info.name](Target& t, const KeyValue& v) {
            t.files[name] = {{.text = v.text, .key = v.full_name, .line = v.line}, member};
            if (v.text.empty()) t.files.erase(name);
        };
        keys_.push_back({std::move(info), set, {}});
        return *this;
    }

    [[nodiscard]] std::span<const Key<Target>> keys() const { return keys_; }
    /// Null where the table has no such key.
    [[nodiscard]] const Key<Target>* find(std::string_view name) const {
        for (const Key<Target>& key : keys_)
            if (key.info.name == name) return &key;
        return nullptr;
    }

  private:
    template <class Member, class Stored>
    static bool read(const Member& member, Stored& stored) {
        stored = Stored(member);
        return true;
    }
    template <class Member, class Stored>
    static bool read(const std::optional<Member>& member, Stored& stored) {
        return member && read(*member, stored);
    }
    static bool read(Vec3 member, KeyValue& value) {
        value.numbers[0] = member.x, value.numbers[1] = member.y, value.numbers[2] = member.z;
        return true;
    }
    KeyTable& add(KeyInfo info, std::function<void(Target&, const KeyValue&)> set,
                  std::function<bool(const Target&, KeyValue&)> get) {
        KeyValue value;
        if (get(Target{}, value)) info.default_text = key_text(info, value);
        keys_.push_back({std::move(info), std::move(set), std::move(get)});
        return *this;
    }

    std::vector<Key<Target>> keys_;
};

/// The tables, one a section of the file.
[[nodiscard]] const KeyTable<HeadDescription>& head_keys();
[[nodiscard]] const KeyTable<MeshDescription>& mesh_keys();
[[nodiscard]] const KeyTable<MapsDescription>& maps_keys();
[[nodiscard]] const KeyTable<MaterialDescription>& material_keys();
[[nodiscard]] const KeyTable<Skin>& skin_keys();
[[nodiscard]] const KeyTable<MotionDescription>& animation_keys();
[[nodiscard]] const KeyTable<LightDescription>& light_keys();
/// A row of [morph], whose keys are the names of targets.
[[nodiscard]] KeyInfo morph_key(const std::string& target);

/// The same of [skin.blood_by_target].
inline constexpr const char* kBloodByTarget = "skin.blood_by_target";
[[nodiscard]] KeyInfo blood_map_key(const std::string& target);
[[nodiscard]] NamedFile blood_map_of(const std::string& target, const KeyValue& value);
[[nodiscard]] const KeyTable<EnvironmentDescription>& environment_keys();
[[nodiscard]] const KeyTable<CameraDescription>& camera_keys();

/// "[maps], [skin]": the sections that have a key of this name; empty where none has it.
[[nodiscard]] std::string sections_with_key(std::string_view name);

}  // namespace dermis::inline scene
