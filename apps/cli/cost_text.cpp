#include "cost_text.h"

#include <algorithm>
#include <cstdio>

namespace dermis::cli {
namespace {

struct Base {
    std::string id;
    double model_ms = 0;
};

Base base_of(const Counted& counted, const std::vector<FrameCost>& costs) {
    const auto base = std::ranges::find_if(counted.contestants, is_cost_base);
    return {base->technique->id, costs[size_t(base - counted.contestants.begin())].model_ms()};
}

std::string count_text(uint64_t count) {
    char text[16];
    if (count < 10'000)
        std::snprintf(text, sizeof text, "%llu", static_cast<unsigned long long>(count));
    else if (count < 10'000'000)
        std::snprintf(text, sizeof text, "%lluk", static_cast<unsigned long long>((count + 500) / 1000));
    else
        std::snprintf(text, sizeof text, "%.1fM", double(count) * 1e-6);
    return text;
}

unsigned long long number(uint64_t value) {
    return value;
}

void print_shader(const std::string& pass, const ShaderCost& shader) {
    const gpu::ShaderStatistics& s = shader.statistics;
    std::printf("%-20.20s %4.4s %6s %6llu %4llu %5llu %5llu %7llu %7llu", pass.c_str(), s.stage.c_str(),
                count_text(shader.invocations).c_str(), number(s.instructions), number(s.vgprs),
                number(s.subgroups_per_simd), number(s.spilled_vgprs + s.spilled_sgprs),
                number(s.latency_cycles), number(s.inverse_throughput_cycles));
}

// Its shaders under each other, what holds for the pass as a whole beside the last. The vertex shader of a
// full-screen triangle runs three times and is left out.
void print_pass(const PassCost& cost) {
    std::string name = cost.pass;
    const ShaderCost* before = nullptr;
    for (const ShaderCost& shader : cost.shaders) {
        if (shader.statistics.stage == "vertex" && shader.invocations <= 3) continue;
        if (before) {
            print_shader(name, *before);
            std::printf("\n");
            name.clear();
        }
        before = &shader;
    }
    if (before)
        print_shader(name, *before);
    else
        std::printf("%-72.20s", name.c_str());
    std::printf(" %6.1f %6.3f %6.3f %6.3f\n", double(cost.bytes) * 1e-6, cost.arithmetic_ms,
                cost.bandwidth_ms, cost.model_ms());
}

nlohmann::ordered_json pass_json(const PassCost& cost) {
    nlohmann::ordered_json shaders = nlohmann::ordered_json::array();
    for (const ShaderCost& shader : cost.shaders) {
        nlohmann::ordered_json entry = {{"stage", shader.statistics.stage},
                                        {"invocations", shader.invocations},
                                        {"subgroup_size", shader.statistics.subgroup_size}};
        for (const gpu::StatisticField& field : gpu::statistic_fields())
            entry[field.name] = shader.statistics.*field.member;
        entry["arithmetic_ms"] = shader.arithmetic_ms;
        shaders.push_back(std::move(entry));
    }
    return {{"pass", cost.pass},
            {"shaders", shaders},
            {"bytes", cost.bytes},
            {"arithmetic_ms", cost.arithmetic_ms},
            {"bandwidth_ms", cost.bandwidth_ms},
            {"model_ms", cost.model_ms()}};
}

}  // namespace

void print_card(const Counted& counted, const Card& card, const std::vector<FrameCost>& costs) {
    for (size_t i = 0; i < costs.size(); ++i) {
        std::printf("%s on %s (%s), modelled: %s, %dx%d\n", counted.contestants[i].name().c_str(),
                    std::string(card.chip).c_str(), std::string(card.name).c_str(), counted.scene.c_str(),
                    counted.size.width, counted.size.height);
        std::printf("%-20s %4s %6s %6s %4s %5s %5s %7s %7s %6s %6s %6s %6s\n", "pass", "", "runs", "instr",
                    "VGPR", "waves", "spill", "latency", "cyc/64", "MB", "ALU ms", "mem ms", "ms");
        for (const PassCost& pass : costs[i].passes) print_pass(pass);
        std::printf("%-93s %6.3f\n\n", "frame", costs[i].model_ms());
    }
    const Base base = base_of(counted, costs);
    std::printf("%-76s %10s %12s\n", (std::string(card.name) + ", model").c_str(), "frame ms",
                ("x " + base.id).c_str());
    for (size_t i = 0; i < costs.size(); ++i)
        std::printf("%-76s %10.3f %12.2f\n", counted.contestants[i].name().c_str(), costs[i].model_ms(),
                    costs[i].model_ms() / base.model_ms);
    std::printf("\n");
}

nlohmann::ordered_json to_json(const Counted& counted) {
    return {{"scene", counted.scene},       {"credit", counted.credit},
            {"width", counted.size.width},  {"height", counted.size.height},
            {"counted_on", counted.device}, {"gpus", nlohmann::ordered_json::array()}};
}

nlohmann::ordered_json to_json(const Counted& counted, const Card& card,
                               const std::vector<FrameCost>& costs) {
    const Base base = base_of(counted, costs);
    nlohmann::ordered_json techniques = nlohmann::ordered_json::array();
    for (size_t i = 0; i < costs.size(); ++i) {
        nlohmann::ordered_json passes = nlohmann::ordered_json::array();
        for (const PassCost& pass : costs[i].passes) passes.push_back(pass_json(pass));
        techniques.push_back({{"technique", counted.contestants[i].technique->id},
                              {"settings", counted.contestants[i].settings},
                              {"model_ms", costs[i].model_ms()},
                              {"ratio_to_" + base.id, costs[i].model_ms() / base.model_ms},
                              {"passes", passes}});
    }
    return {{"chip", card.chip},
            {"card", card.name},
            {"clock_ghz", card.clock_ghz},
            {"compute_units", card.compute_units},
            {"bandwidth_gb_s", card.bandwidth_gb_s},
            {"source", card.source},
            {"techniques", techniques}};
}

}  // namespace dermis::cli
