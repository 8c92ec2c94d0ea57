// `dermis bake pigments`: an albedo map as maps of melanin and blood, with edits.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "bake_options.h"
#include "dermis/base/file.h"
#include "dermis/base/progress.h"
#include "dermis/base/text.h"
#include "dermis/image/io.h"
#include "dermis/optics/tissue/pigment_maps.h"
#include "profile_skin.h"

namespace dermis::cli {
namespace {

struct BakePigmentsOptions {
    std::string albedo, output, mask;
    SkinModel model;
    SkinEdit edit;
    double exposure = 1;
};

struct PigmentPaths {
    std::filesystem::path melanin, blood, residue, albedo;
};

Result<PigmentPaths> paths_of(const BakePigmentsOptions& options) {
    const std::filesystem::path path = utf8_path(options.output);
    if (to_lower(path.extension().string()) != ".png")
        return Error{"-o " + options.output + ": maps of pigments are written as NAME.png"};
    const auto beside = [&](const char* what) {
        std::filesystem::path named = path;
        return named.replace_filename(path.stem().string() + "_" + what + ".png");
    };
    return PigmentPaths{beside("melanin"), beside("blood"), beside("residue"), beside("albedo")};
}

Result<FileUse> pigment_files(const BakePigmentsOptions& options) {
    DERMIS_TRY_ASSIGN(const PigmentPaths paths, paths_of(options));
    return FileUse{.outputs = {paths.melanin, paths.blood, paths.residue, paths.albedo},
                   .inputs = {options.albedo, options.mask}};
}

// All of them or none.
Result<void> write_pictures(const std::vector<std::pair<std::filesystem::path, const Image*>>& pictures) {
    std::vector<std::vector<std::byte>> encoded;
    std::vector<FileContent> files;
    for (const auto& [path, image] : pictures) {
        DERMIS_TRY_ASSIGN(std::vector<std::byte> bytes, encode_image(".png", *image));
        encoded.push_back(std::move(bytes));
        files.push_back({path, encoded.back()});
    }
    return write_files(files);
}

Result<int> bake_pigments(const BakePigmentsOptions& options) {
    DERMIS_TRY_ASSIGN(const PigmentPaths paths, paths_of(options));
    DERMIS_TRY(check(options.model));
    DERMIS_TRY_ASSIGN(const LoadedImage albedo, read_image(utf8_path(options.albedo), ImageUse::color));
    Image mask;
    if (!options.mask.empty()) {
        DERMIS_TRY_ASSIGN(LoadedImage loaded, read_image(utf8_path(options.mask), ImageUse::data));
        mask = std::move(loaded.image);
    }
    Progress line("pigments", 2 * albedo.image.pixel_count());
    const auto advance = [&](size_t texels) { line.advance(texels); };
    const PigmentTable table(options.model);
    const PigmentMaps maps = pigment_maps_of(albedo.image, table, options.exposure, advance);
    const PigmentPainting painting{
        .maps = &maps, .missing = {}, .edit = options.edit, .mask = mask.empty() ? nullptr : &mask};
    DERMIS_TRY_ASSIGN(const Image made, albedo_of(painting, table, advance));
    DERMIS_TRY(write_pictures({{paths.melanin, &maps.melanin},
                               {paths.blood, &maps.blood},
                               {paths.residue, &maps.residue},
                               {paths.albedo, &made}}));
    const Pigments mean = mean_pigments(painting);
    std::printf("mean melanin %.4f, blood %.4f\n", mean.melanin, mean.blood);
    for (const auto* path : {&paths.melanin, &paths.blood, &paths.residue, &paths.albedo}) print_path(*path);
    return 0;
}

}  // namespace

void add_bake_pigments_command(CommandLine& line) {
    auto options = std::make_shared<BakePigmentsOptions>();
    Command* command = line.add("pigments", "An albedo map as maps of melanin and blood, with edits",
                                "dermis bake pigments face.png -o face.png\n"
                                "  dermis bake pigments face.png --blush 0.7 --mask cheeks.png -o blush.png",
                                bake_group(line));
    command->add_option("ALBEDO", options->albedo, "image of the skin's colour")->required();
    command
        ->add_output("-o,--output", options->output,
                     "NAME.png: writes NAME_melanin, NAME_blood, NAME_residue (16 bit) and NAME_albedo, the "
                     "colour after the edits")
        ->required();
    command
        ->add_option("--exposure", options->exposure, {0.1, 10},
                     "divides the map before its pigments are read: 1.3 for a map that is 30 % too bright")
        ->capture_default_str();
    SkinEdit& edit = options->edit;
    const auto scale = [&](const char* flag, double& value, const char* help) {
        command->add_option(flag, value, {0, 10}, help)->capture_default_str();
    };
    const auto part = [&](const char* flag, double& value, const char* help) {
        command->add_option(flag, value, {0, 1}, help)->capture_default_str();
    };
    scale("--melanin-scale", edit.melanin_scale, "multiplies melanin");
    scale("--blood-scale", edit.blood_scale, "multiplies blood");
    part("--tan", edit.tan, "1 adds a melanin fraction of 0.03");
    part("--pallor", edit.pallor, "1 takes all blood away");
    part("--blush", edit.blush, "1 adds a blood fraction of 0.03");
    part("--age", edit.age, "1 doubles the unevenness of melanin, takes a third of the blood");
    command->add_option("--mask", options->mask, "image, red channel: where the edits act; any size");
    for (const SkinModelKey& key : skin_model_keys())
        if (key.name == "oxygen" || key.name == "epidermis_mm" || key.name == "pheomelanin")
            command
                ->add_option(skin_flag_of(key.name), options->model.*key.member, {key.min, key.max},
                             std::string(key.meaning))
                ->capture_default_str();
    line.when_chosen(
        command, [options] { return pigment_files(*options); },
        [options] { return bake_pigments(*options); });
}

}  // namespace dermis::cli
