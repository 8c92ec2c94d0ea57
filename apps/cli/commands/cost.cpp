// dermis cost: estimates the cost of techniques on GPUs that this machine does not have.

#include <cstdio>
#include <memory>

#include "catalog/catalog.h"
#include "command.h"
#include "cost_text.h"
#include "dermis/base/text.h"
#include "dermis/render/complete_scene.h"
#include "scene_choice.h"

namespace dermis::cli {
namespace {

struct CostOptions {
    std::vector<std::string> techniques;
    std::string gpus = "navi21", size = "1920x1080", device;
    SceneChoice scene = {.name = "bust"};
    bool json = false;
};

Result<std::vector<Contestant>> chosen_techniques(const std::vector<std::string>& texts) {
    const std::span<const Technique> techniques = built_in_catalog().techniques;
    if (texts.empty()) return default_contestants(techniques);
    Result<std::vector<Contestant>> chosen = parse_technique_list(techniques, join(texts, ","));
    return chosen ? with_cost_base(std::move(*chosen), techniques) : chosen;
}

Result<Counted> count(const CostOptions& options) {
    Counted counted;
    const Result<Size> size = parse_size(options.size);
    if (!size) return size.error();
    counted.size = *size;
    for (const std::string_view chip : split(options.gpus, ',')) {
        const Result<const Card*> card = find_card(trim(chip));
        if (!card) return card.error().within("--gpu");
        counted.cards.push_back(*card);
    }
    Result<std::vector<Contestant>> contestants = chosen_techniques(options.techniques);
    if (!contestants) return contestants.error();
    counted.contestants = std::move(*contestants);
    Result<Scene> scene = options.scene.load();
    if (!scene) return scene.error();
    DERMIS_TRY(complete_scene(*scene));
    counted.scene = scene->name, counted.credit = scene->credit;

    Result<gpu::Device> device = gpu::Device::create({.name_contains = options.device});
    if (!device) return device.error();
    counted.device = device->info().name;
    DERMIS_TRY_ASSIGN(Renderer renderer,
                      Renderer::create(*device, gpu::embedded_shaders(built_in_catalog().shaders), *scene));
    for (const Contestant& contestant : counted.contestants) {
        DERMIS_TRY_ASSIGN(FrameWork work, count_work(renderer, contestant, size->width, size->height));
        counted.frames.push_back(std::move(work));
    }
    return counted;
}

Result<int> print_costs(const CostOptions& options) {
    const Result<Counted> counted = count(options);
    if (!counted) return counted.error();
    nlohmann::ordered_json json = {
        {"scene", counted->scene},       {"credit", counted->credit},
        {"width", counted->size.width},  {"height", counted->size.height},
        {"counted_on", counted->device}, {"gpus", nlohmann::ordered_json::array()}};
    for (const Card* card : counted->cards) {
        DERMIS_TRY_ASSIGN(
            const std::vector<FrameCost> costs,
            model_frames(counted->frames, *card, gpu::embedded_shaders(built_in_catalog().shaders)));
        if (options.json)
            json["gpus"].push_back(to_json(*counted, *card, costs));
        else
            print_card(*counted, *card, costs);
    }
    if (options.json) std::printf("%s\n", json.dump(2).c_str());
    if (!options.json)
        std::printf(
            "Fragments counted on %s.\nThis is a model, not a measurement: docs/performance.md has its "
            "assumptions.\n",
            counted->device.c_str());
    return 0;
}

}  // namespace

void add_cost_command(CommandLine& line) {
    const auto options = std::make_shared<CostOptions>();
    Command* command = line.add("cost", "Estimates the cost of techniques on GPUs you do not own",
                                "dermis cost lambert \"preintegrated[shadow=plain]\" --gpu navi21,navi31");
    command->add_option("TECHNIQUES", options->techniques,
                        "technique or technique[name=value,...]; several; all when none is given");
    std::string chips;
    for (const Card& card : cards()) chips += (chips.empty() ? "" : ", ") + std::string(card.chip);
    command->add_option("--gpu", options->gpus, "chips to compile for, separated by commas: " + chips)
        ->capture_default_str();
    command->add_option("--size", options->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    command
        ->add_option("--fragments-of", options->scene.name,
                     "scene file, mesh or name of a scene whose fragments are counted")
        ->capture_default_str();
    options->scene.add_options_to(*command);
    command->add_option("--device", options->device, "count on the Vulkan device with this text in its name");
    command->add_flag("--json", options->json, "print one JSON object instead");
    line.when_chosen(command, writes_nothing, [options] { return print_costs(*options); });
}

}  // namespace dermis::cli
