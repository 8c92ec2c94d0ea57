// dermis export: the shading functions with a skin's coefficients, in the language of an engine, or as a
// folder that the engine or a browser opens.

#include <cstdio>
#include <memory>

#include "catalog/catalog.h"
#include "command.h"
#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/engines/native.h"
#include "dermis/engines/package.h"
#include "dermis/optics/presets.h"
#include "dermis/shading/skin_text.h"
#include "head_export.h"
#include "profile_options.h"
#include "scene_choice.h"
#include "web_export.h"

namespace dermis::cli {
namespace {

constexpr const char *kDefaultPage = "bust", *kDefaultProfile = "gpu_gems_3";

struct ExportOptions {
    std::string language, engine, profile, output, functions;
    SceneChoice scene;
    bool web = false, native = false;

    [[nodiscard]] bool has_scene() const {
        return !scene.name.empty() || !scene.words.empty() || !scene.camera.empty() || !scene.light.empty() ||
               scene.pose.given();
    }
};

constexpr const char* kAllLanguages = "all";

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

// A package's and a page's files are known when they are made; `inputs` stay as they are.
Result<int> deliver_files(std::span<const FileContent> files, std::vector<std::filesystem::path> inputs) {
    FileUse use = {.outputs = {}, .inputs = std::move(inputs)};
    for (const FileContent& file : files) use.outputs.push_back(file.path);
    DERMIS_TRY(check_outputs(use));
    DERMIS_TRY(write_files(files));
    for (const FileContent& file : files) print_path(file.path);
    return 0;
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

Result<int> export_texts(const ExportOptions& options, const Profile& profile) {
    DERMIS_TRY_ASSIGN(const std::vector<shading::Language> languages, chosen_languages(options.language));
    Texts names;
    for (const std::string_view name : split(options.functions, ','))
        if (const std::string_view word = trim(name); !word.empty()) names.emplace_back(word);
    DERMIS_TRY_ASSIGN(const Texts texts, skin_texts(profile, languages, names));
    std::vector<FileContent> files;
    for (size_t i = 0; i < texts.size(); ++i)
        files.push_back({text_path(options, languages[i]), as_bytes(texts[i])});
    return deliver_files(files, {options.profile});
}

Result<int> write_folder(const ExportOptions& options, const std::vector<PackageFile>& package,
                         std::vector<std::filesystem::path> inputs) {
    const std::filesystem::path folder = options.output;
    std::vector<FileContent> files;
    for (const PackageFile& file : package) files.push_back({folder / file.path, file.bytes});
    return deliver_files(files, std::move(inputs));
}

Result<int> export_native(const ExportOptions& options, const Profile& profile) {
    DERMIS_TRY_ASSIGN(const std::vector<PackageFile> files,
                      make_native_profile(options.engine, profile, built_in_package_templates()));
    return write_folder(options, files, {options.profile});
}

Result<int> export_package(const ExportOptions& options) {
    ExportedHead head = {.profile = options.profile.empty() ? kDefaultProfile : options.profile};
    if (options.has_scene()) {
        DERMIS_TRY_ASSIGN(head, export_head(options.scene, options.profile, options.engine));
        print_warnings(head.head.warnings);
    }
    DERMIS_TRY_ASSIGN(const Profile profile, find_profile(head.profile));
    DERMIS_TRY_ASSIGN(const ShadowPlaces places, package_shadow_places(profile));
    DERMIS_TRY_ASSIGN(const PackageGain gain, package_gain(profile, head.settings));
    head.inputs.emplace_back(options.profile);
    DERMIS_TRY_ASSIGN(const std::vector<PackageFile> package,
                      make_package(options.engine, {.profile = profile,
                                                    .functions = shading::skin_sources(),
                                                    .templates = built_in_package_templates(),
                                                    .shadow_places = places,
                                                    .gain = gain,
                                                    .head = head.head.files}));
    return write_folder(options, package, head.inputs);
}

Result<int> export_web(const ExportOptions& options) {
    SceneChoice scene = options.scene;
    if (scene.name.empty()) scene.name = kDefaultPage;
    const std::filesystem::path folder = options.output;
    std::vector<std::filesystem::path> inputs;
    DERMIS_TRY_ASSIGN(const WebPage page, make_web_page(scene, options.profile, inputs));
    print_warnings(page.warnings);
    std::vector<FileContent> files;
    for (const WebFile& file : page.files) files.push_back({folder / file.path, file.bytes});
    return deliver_files(files, std::move(inputs));
}

Result<FileUse> files_of(const ExportOptions& options) {
    if (int(!options.language.empty()) + int(!options.engine.empty()) + int(options.web) != 1)
        return Error{
            "give one of --language for a file of functions, --engine for a folder, --web for a page"};
    if (!options.functions.empty() && options.language.empty())
        return Error{"--functions chooses what --language writes"};
    if (options.native && (options.engine.empty() || options.has_scene()))
        return Error{
            "--native needs --engine and takes no scene: it writes the profile of the engine's own skin"};
    FileUse files = {.outputs = {}, .inputs = {options.profile, options.scene.name}};
    const std::filesystem::path output = options.output;
    if (options.web) {
        files.outputs = {output / "index.html"};
        return files;
    }
    if (!options.language.empty() && options.has_scene())
        return Error{"a scene and --scene, --camera, --light are for --engine and --web"};
    if (!options.engine.empty()) {
        DERMIS_TRY(options.native ? check_native_engine(options.engine) : check_engine(options.engine));
        if (options.has_scene() && options.scene.name.empty())
            return Error{"--scene, --camera and --light need a SCENE"};
        files.outputs = {output / "README.md"};
        return files;
    }
    DERMIS_TRY_ASSIGN(const std::vector<shading::Language> languages, chosen_languages(options.language));
    for (const shading::Language language : languages) files.outputs.push_back(text_path(options, language));
    return files;
}

Result<int> run(const ExportOptions& options) {
    if (options.web) return export_web(options);
    if (!options.engine.empty() && !options.native) return export_package(options);
    DERMIS_TRY_ASSIGN(const Profile profile,
                      find_profile(options.profile.empty() ? kDefaultProfile : options.profile));
    return options.native ? export_native(options, profile) : export_texts(options, profile);
}

}  // namespace

void add_export_command(CommandLine& line) {
    auto options = std::make_shared<ExportOptions>();
    Command* command = line.add(
        "export", "A skin for other programs: shading functions as text, a package for an engine, a web page",
        "dermis export --engine three bust -o package/\n"
        "  dermis export --engine godot --profile openpbr_skin_5 -o package/\n"
        "  dermis export --web head_scan --scene light.key.intensity=2 -o page/\n"
        "  dermis export --language hlsl --profile openpbr_skin_5 -o skin.hlsl");
    command->add_option("--language", options->language,
                        join(shading::language_names(), ", ") + ", or all: a file of each in a folder");
    command->add_option("--functions", options->functions,
                        "with --language: these functions and what they need, separated by commas, such as "
                        "skin_diffuse,skin_gain (default: all)");
    command->add_option(
        "--engine", options->engine,
        "a folder with shader, table, import settings and an example, with a SCENE its head too: " +
            join(engine_names(), ", "));
    command->add_flag(
        "--native", options->native,
        "with --engine: the profile of the engine's own skin instead, as an asset or script and "
        "numbers to type in: " +
            join(native_engine_names(), ", "));
    command->add_flag("--web", options->web,
                      "a folder for any web server: a page that shows a scene's skin (default: bust)");
    command->add_option(
        "--profile", options->profile,
        kProfileNames + ("; default: " + std::string(kDefaultProfile)) + ", with a scene the scene's");
    options->scene.add_to(*command);
    command
        ->add_output("-o,--output", options->output,
                     "file to write; with --engine, --web or --language all a folder")
        ->required();
    line.when_chosen(
        command, [options] { return files_of(*options); }, [options] { return run(*options); });
}

}  // namespace dermis::cli
