// Words of material names in MetaHuman, Character Creator, MakeHuman, DAZ, VRoid and ICT FaceKit heads.

#include "dermis/scene/part_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "dermis/base/text.h"

namespace dermis::inline scene {
namespace {

// Of a name with words of several groups the first group of this order wins: "FaceBrow" is hair, "EyeSocket"
// skin, "EyeShell" clear.
enum class WordGroup { hair, eyelid, shell, shell_of_eye, tooth, mouth, thing, cloth, eye, skin, filler };

struct WordList {
    WordGroup group;
    std::vector<std::string_view> words;
};

const std::vector<WordList>& word_lists() {
    static const std::vector<WordList> kLists = {
        {WordGroup::hair,
         {"hair", "hairs", "lash", "lashes", "eyelash", "eyelashes", "brow", "brows", "eyebrow", "eyebrows",
          "beard", "moustache", "mustache", "stubble", "fuzz", "ponytail", "haircard", "haircards",
          "sideburns"}},
        {WordGroup::eyelid, {"eyelid", "eyelids", "lid", "lids", "socket", "sockets", "eyesocket"}},
        {WordGroup::shell,
         {"cornea", "corneas", "tear", "tears", "tearline", "lacrimal", "moist", "moisture", "saliva",
          "eyeedge", "eyeshell", "eyewet", "waterline"}},
        {WordGroup::shell_of_eye,
         {"occlusion", "edge", "shell", "blend", "wet", "wetness", "highlight", "reflection", "fluid",
          "lens"}},
        {WordGroup::tooth, {"tooth", "teeth", "denture", "dentures", "fang", "fangs"}},
        {WordGroup::mouth, {"mouth", "gum", "gums", "tongue", "palate", "oral"}},
        {WordGroup::thing,
         {"glass", "glasses", "eyeglasses", "eyewear", "goggles", "earring", "earrings", "jewel", "jewelry",
          "jewellery", "necklace", "piercing", "button", "buttons", "zipper", "metal", "patch", "prop"}},
        {WordGroup::cloth,
         {"cloth",   "clothes", "clothing", "shirt",  "tshirt",   "pants", "trousers", "dress",  "jacket",
          "coat",    "suit",    "shoe",     "shoes",  "boot",     "boots", "sock",     "socks",  "glove",
          "gloves",  "hat",     "cap",      "helmet", "belt",     "skirt", "scarf",    "collar", "bra",
          "sweater", "hoodie",  "jeans",    "fabric", "leather",  "denim", "bottoms",  "tops",   "underwear",
          "uniform", "vest",    "headband", "turban", "headscarf"}},
        {WordGroup::eye,
         {"eye", "eyes", "eyeball", "eyeballs", "sclera", "scleras", "iris", "irises", "pupil", "pupils",
          "caruncle", "cartilage"}},
        {WordGroup::skin,
         {"skin",        "face",     "head",     "body",    "lip",      "lips",     "ear",   "ears",
          "nose",        "nostril",  "nostrils", "neck",    "torso",    "chest",    "arm",   "arms",
          "leg",         "legs",     "hand",     "hands",   "foot",     "feet",     "nail",  "nails",
          "fingernails", "toenails", "finger",   "fingers", "toe",      "toes",     "cheek", "chin",
          "cheeks",      "forehead", "scalp",    "flesh",   "backhead", "shoulders"}},
        {WordGroup::filler, {"left",  "right", "upper", "lower",    "inner", "outer", "back",  "front",
                             "l",     "r",     "mat",   "material", "mtl",   "std",   "white", "card",
                             "cards", "line",  "high",  "low",      "poly",  "ball",  "and",   "with"}}};
    return kLists;
}

std::optional<WordGroup> group_of(std::string_view word) {
    for (const WordList& list : word_lists())
        if (std::ranges::find(list.words, word) != list.words.end()) return list.group;
    return std::nullopt;
}

// "M_EyeLashes02" is m, eye, lashes; "UVHead" is uv, head.
std::vector<std::string> pieces_of(std::string_view name) {
    const auto is = [&](size_t i, auto test) {
        return i < name.size() && test(static_cast<unsigned char>(name[i])) != 0;
    };
    const auto upper = [](int c) { return std::isupper(c); };
    const auto lower = [](int c) { return std::islower(c); };
    const auto alpha = [](int c) { return std::isalpha(c); };
    std::vector<std::string> pieces;
    bool inside = false;
    for (size_t i = 0; i < name.size(); ++i) {
        if (!is(i, alpha)) {
            inside = false;
            continue;
        }
        const bool starts = is(i, upper) && i > 0 && (is(i - 1, lower) || is(i + 1, lower));
        if (!inside || starts) pieces.emplace_back();
        pieces.back() += char(std::tolower(static_cast<unsigned char>(name[i])));
        inside = true;
    }
    return pieces;
}

// The known words that a piece consists of, the longest first ones preferred; none unless they cover it.
std::vector<std::string> words_of(const std::string& piece) {
    constexpr size_t kLongest = 40;
    if (group_of(piece)) return {piece};
    if (piece.size() > kLongest) return {};
    std::vector<std::vector<std::string>> covered(piece.size() + 1);
    std::vector<bool> reached(piece.size() + 1);
    reached[0] = true;
    for (size_t end = 1; end <= piece.size(); ++end)
        for (size_t begin = 0; begin < end && !reached[end]; ++begin) {
            const std::string word = piece.substr(begin, end - begin);
            if (!reached[begin] || word.size() < 3 || !group_of(word)) continue;
            reached[end] = true;
            covered[end] = covered[begin];
            covered[end].push_back(word);
        }
    return covered[piece.size()];
}

HeadPart part_of(WordGroup group) {
    switch (group) {
        case WordGroup::hair:
            return HeadPart::hair;
        case WordGroup::shell:
        case WordGroup::shell_of_eye:
            return HeadPart::clear;
        case WordGroup::tooth:
            return HeadPart::teeth;
        case WordGroup::mouth:
            return HeadPart::mouth;
        case WordGroup::cloth:
            return HeadPart::cloth;
        case WordGroup::eye:
            return HeadPart::eye;
        case WordGroup::eyelid:
        case WordGroup::skin:
            return HeadPart::skin;
        case WordGroup::thing:
        case WordGroup::filler:
            break;
    }
    return HeadPart::other;
}

struct Found {
    WordGroup group;
    std::string word;
};

std::vector<Found> known_words(std::string_view name) {
    std::vector<Found> found;
    for (const std::string& piece : pieces_of(name))
        for (const std::string& word : words_of(piece))
            if (const auto group = group_of(word); *group != WordGroup::filler)
                found.push_back({*group, word});
    const bool has_eye = std::ranges::any_of(found, [](const Found& f) { return f.group == WordGroup::eye; });
    // "edge" or "shell" alone says nothing.
    if (!has_eye) std::erase_if(found, [](const Found& f) { return f.group == WordGroup::shell_of_eye; });
    return found;
}

}  // namespace

std::optional<PartWord> part_of_name(std::string_view name) {
    const std::vector<Found> found = known_words(name);
    if (found.empty()) return std::nullopt;
    const Found& first = *std::ranges::min_element(found, {}, &Found::group);
    return PartWord{part_of(first.group), first.word};
}

bool names_several_parts(std::string_view name) {
    const std::optional<PartWord> first = part_of_name(name);
    const std::vector<Found> found = known_words(name);
    return std::ranges::any_of(found, [&](const Found& f) {
        const HeadPart part = part_of(f.group);
        // The eye of an eyelash or an eye's shell is not another part.
        return part != first->part && !(part == HeadPart::eye && first->part != HeadPart::skin);
    });
}

bool names_iris(std::string_view name) {
    constexpr std::array<std::string_view, 4> kIris = {"iris", "irises", "pupil", "pupils"};
    const std::vector<Found> found = known_words(name);
    return std::ranges::any_of(found, [&](const Found& f) { return std::ranges::count(kIris, f.word) > 0; });
}

const std::vector<std::string>& part_names() {
    static const std::vector<std::string> kNames = {"skin",  "other", "translucent", "eye",  "clear",
                                                    "teeth", "mouth", "hair",        "cloth"};
    return kNames;
}

const std::string& part_name(HeadPart part) {
    return part_names().at(size_t(part));
}

}  // namespace dermis::inline scene
