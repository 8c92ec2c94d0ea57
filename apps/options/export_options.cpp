#include "export_options.h"

#include "catalog/catalog.h"
#include "dermis/base/text.h"
#include "dermis/engines/native.h"
#include "dermis/optics/presets.h"
#include "dermis/shading/skin_text.h"
#include "head_export.h"
#include "web_export.h"

namespace dermis::cli {
namespace {

constexpr const char *kDefaultPage = "bust", *kAllLanguages = "all";

bool has_scene(const ExportOptions& options) {
    const SceneChoice& scene = options.scene;
    return !scene.name.empty() || !scene.words.empty() || !scene.camera.empty() || !scene.light.empty() ||
           scene.pose.given();
}

Result<std::vector<shading::Language>> chosen_languages(const std::string& name) {
    std::vector<shading::Language> languages;
    std::vector<std::string> names = shading::language_names();
    for (const std::string& known : names) {
        const Result<shading::Language> language = shading::find_language(known);
        if (language && (name == known || name == kAllLanguages)) languages.push_back(*language);
    }
    if (!languages.empty()) return languages;
    names.emplace_back(kAllLanguages);
    return Error{unknown_name("language", name, names)};
}

std::filesystem::path text_path(const ExportOptions& options, shading::Language language) {
    const std::filesystem::path output = options.output;
    return options.language == kAllLanguages
               ? output / ("skin" + std::string(shading::file_extension(language)))
               : output;
}

using Texts = std::vector<std::string>;

// One text for each language; of the functions `names`, or of all.
Result<Texts> texts_with_gain(const Profile& profile, const PackageGain& gain,
                              std::span<const shading::Language> languages, const Texts& names) {
    DERMIS_TRY_ASSIGN(shading::Source own_gain, gain_source(built_in_package_templates(), gain));
    const std::span<const shading::Source> common = shading::skin_sources();
    std::vector<shading::Source> sources(common.begin(), common.end());
    sources.push_back(std::move(own_gain));
    Texts texts;
    for (const shading::Language language : languages) {
        DERMIS_TRY_ASSIGN(std::string text, skin_text(profile, sources, language, names));
        texts.push_back(std::move(text));
    }
    return texts;
}

// Walks find the gain, unless it is cached. Functions that do not need it have the same text with any two
// gains.
Result<Texts> skin_texts(const Profile& profile, std::span<const shading::Language> languages,
                         const Texts& names) {
    const PackageGain none,
        other = {.of_curvature = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, .of_slabs = {2, 2, 2}};
    if (!names.empty()) {
        DERMIS_TRY_ASSIGN(Texts without, texts_with_gain(profile, none, languages, names));
        DERMIS_TRY_ASSIGN(const Texts with, texts_with_gain(profile, other, languages, names));
        if (with == without) return without;
    }
    DERMIS_TRY_ASSIGN(const PackageGain gain, package_gain(profile, {}));
    return texts_with_gain(profile, gain, languages, names);
}

Result<Exported> export_texts(const ExportOptions& options, const Profile& profile) {
    DERMIS_TRY_ASSIGN(const std::vector<shading::Language> languages, chosen_languages(options.language));
    Texts names;
    for (const std::string_view name : split(options.functions, ','))
        if (const std::string_view word = trim(name); !word.empty()) names.emplace_back(word);
    DERMIS_TRY_ASSIGN(const Texts texts, skin_texts(profile, languages, names));
    Exported made;
    for (size_t i = 0; i < texts.size(); ++i) {
        const std::span<const std::byte> bytes = as_bytes(texts[i]);
        made.files.push_back({text_path(options, languages[i]).string(), {bytes.begin(), bytes.end()}});
    }
    return made;
}

// In the folder that is the output.
template <class File>
Exported in_folder(const ExportOptions& options, std::vector<File> files) {
    Exported made;
    for (File& file : files)
        made.files.push_back(
            {(std::filesystem::path(options.output) / file.path).string(), std::move(file.bytes)});
    return made;
}

// Functions, or the profile of an engine's own skin.
Result<Exported> export_profile(const ExportOptions& options) {
    DERMIS_TRY_ASSIGN(const Profile profile,
                      find_profile(options.profile.empty() ? kExportProfile : options.profile));
    if (!options.native) return export_texts(options, profile);
    DERMIS_TRY_ASSIGN(std::vector<PackageFile> files,
                      make_native_profile(options.engine, profile, built_in_package_templates()));
    return in_folder(options, std::move(files));
}

Result<Exported> export_package(const ExportOptions& options) {
    ExportedHead head = {.profile = options.profile.empty() ? kExportProfile : options.profile};
    if (has_scene(options)) {
        DERMIS_TRY_ASSIGN(head, export_head(options.scene, options.profile, options.engine));
    }
    DERMIS_TRY_ASSIGN(const Profile profile, find_profile(head.profile));
    DERMIS_TRY_ASSIGN(const ShadowPlaces places, package_shadow_places(profile));
    DERMIS_TRY_ASSIGN(const PackageGain gain, package_gain(profile, head.settings));
    DERMIS_TRY_ASSIGN(std::vector<PackageFile> package,
                      make_package(options.engine, {.profile = profile,
                                                    .functions = shading::skin_sources(),
                                                    .templates = built_in_package_templates(),
                                                    .shadow_places = places,
                                                    .gain = gain,
                                                    .head = head.head.files}));
    Exported made = in_folder(options, std::move(package));
    made.inputs = std::move(head.inputs);
    made.warnings = std::move(head.head.warnings);
    return made;
}

Result<Exported> export_web(const ExportOptions& options) {
    SceneChoice scene = options.scene;
    if (scene.name.empty()) scene.name = kDefaultPage;
    std::vector<std::filesystem::path> inputs;
    DERMIS_TRY_ASSIGN(WebPage page, make_web_page(scene, options.profile, inputs));
    Exported made = in_folder(options, std::move(page.files));
    made.inputs = std::move(inputs);
    made.warnings = std::move(page.warnings);
    return made;
}

}  // namespace

Result<FileUse> ExportOptions::files() const {
    if (int(!language.empty()) + int(!engine.empty()) + int(web) != 1)
        return Error{
            "give one of --language for a file of functions, --engine for a folder, --web for a page"};
    if (!functions.empty() && language.empty()) return Error{"--functions chooses what --language writes"};
    if (native && (engine.empty() || has_scene(*this)))
        return Error{
            "--native needs --engine and takes no scene: it writes the profile of the engine's own skin"};
    FileUse files = {.outputs = {}, .inputs = {profile, scene.name}};
    const std::filesystem::path folder = output;
    if (web) {
        files.outputs = {folder / "index.html"};
        return files;
    }
    if (!language.empty() && has_scene(*this))
        return Error{"a scene and --scene, --camera, --light are for --engine and --web"};
    if (!engine.empty()) {
        DERMIS_TRY(native ? check_native_engine(engine) : check_engine(engine));
        if (has_scene(*this) && scene.name.empty())
            return Error{"--scene, --camera and --light need a SCENE"};
        files.outputs = {folder / "README.md"};
        return files;
    }
    DERMIS_TRY_ASSIGN(const std::vector<shading::Language> languages, chosen_languages(language));
    for (const shading::Language one : languages) files.outputs.push_back(text_path(*this, one));
    return files;
}

Result<Exported> make_export(const ExportOptions& options) {
    const bool is_package = !options.engine.empty() && !options.native;
    DERMIS_TRY_ASSIGN(Exported made, options.web  ? export_web(options)
                                     : is_package ? export_package(options)
                                                  : export_profile(options));
    made.inputs.emplace_back(options.profile);
    return made;
}

// A package's and a page's files are known when they are made; the inputs stay as they are.
Result<void> write_export(const Exported& made) {
    FileUse use = {.outputs = {}, .inputs = made.inputs};
    std::vector<FileContent> contents;
    for (const PackageFile& file : made.files) {
        use.outputs.emplace_back(file.path);
        contents.push_back({file.path, file.bytes});
    }
    DERMIS_TRY(check_outputs(use));
    return write_files(contents);
}

}  // namespace dermis::cli
