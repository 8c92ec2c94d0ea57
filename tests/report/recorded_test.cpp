// No shader's instructions, registers or spills rise unseen. Records are kept for each version of Mesa that
// was seen. DERMIS_UPDATE_COSTS=1 records those of this version again, =missing those alone that have no
// record.

#include <algorithm>
#include <cstdlib>
#include <map>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "report/null_device.h"
#include "test_paths.h"

using namespace dermis;

namespace {

constexpr const char* kRecordedCosts = DERMIS_SOURCE_DIR "/tests/report/recorded_costs.csv";
constexpr std::string_view kHeading =
    "driver,chip,technique,pass,stage,instructions,vgprs,spilled,subgroups_per_simd,inverse_throughput_"
    "cycles\n";

struct CostRecord {
    uint64_t instructions = 0, vgprs = 0, spilled = 0, subgroups = 0, cycles = 0;
};
/// By "driver,chip,technique,pass,stage".
using CostRecords = std::map<std::string, CostRecord>;

std::string costs_csv(const CostRecords& records) {
    std::string text(kHeading);
    for (const auto& [key, r] : records) {
        text += key;
        for (const uint64_t value : {r.instructions, r.vgprs, r.spilled, r.subgroups, r.cycles})
            text += "," + std::to_string(value);
        text += "\n";
    }
    return text;
}

CostRecords parse_costs(std::string_view text) {
    CostRecords records;
    for (const std::string_view line : split(text, '\n')) {
        const std::vector<std::string_view> cells = split(line, ',');
        if (line.empty() || kHeading.starts_with(line)) continue;
        if (cells.size() != 10) {
            ADD_FAILURE() << "not a record: " << line;
            continue;
        }
        const auto value = [&](size_t i) { return uint64_t(parse_number(cells[i]).value_or(0)); };
        const std::string key(line.substr(0, size_t(cells[5].data() - line.data()) - 1));
        records[key] = {value(5), value(6), value(7), value(8), value(9)};
    }
    return records;
}

std::vector<std::string> rises(const CostRecords& now, const CostRecords& before) {
    std::vector<std::string> found;
    for (const auto& entry : now) {
        const std::string& key = entry.first;
        const CostRecord& r = entry.second;
        const auto old = before.find(key);
        if (old == before.end()) {
            found.push_back(key + " is not recorded");
            continue;
        }
        const auto compare = [&](const char* what, uint64_t value, uint64_t recorded) {
            if (value > recorded)
                found.push_back(key + ": " + what + " rose from " + std::to_string(recorded) + " to " +
                                std::to_string(value));
        };
        compare("instructions", r.instructions, old->second.instructions);
        compare("VGPRs", r.vgprs, old->second.vgprs);
        compare("spilled registers", r.spilled, old->second.spilled);
    }
    return found;
}

class RecordedCosts : public NullDeviceTest {
  protected:
    // "radv Mesa 25.0.7" of "radv Mesa 25.0.7-2+deb13u1".
    std::string mesa() const { return driver().substr(0, driver().find('-')); }

    // Passes that a technique shares with lambert are recorded once, there. Vertex shaders cost too little to
    // record.
    CostRecords measure() {
        CostRecords records;
        std::vector<std::string> shared;
        for (const Pass& pass : frame_of("lambert").passes)
            if (pass.name != "skin") shared.push_back(pass.name);
        for (const Technique& technique : built_in_catalog().techniques)
            for (const gpu::PassStatistics& pass : compile(frame_of(technique.id))) {
                const bool is_shared = std::ranges::find(shared, pass.pass) != shared.end();
                if (is_shared && technique.id != "lambert") continue;
                for (const gpu::ShaderStatistics& s : pass.shaders)
                    if (s.stage != "vertex")
                        records[mesa() + "," + std::string(kChip) + "," + technique.id + "," + pass.pass +
                                "," + s.stage] = {s.instructions, s.vgprs, s.spilled_vgprs + s.spilled_sgprs,
                                                  s.subgroups_per_simd, s.inverse_throughput_cycles};
            }
        return records;
    }
};

}  // namespace

TEST_F(RecordedCosts, no_shader_has_more_instructions_registers_or_spills_than_recorded) {
    const CostRecords now = measure();
    ASSERT_GT(now.size(), 20u);
    const auto text = read_text_file(kRecordedCosts);
    ASSERT_TRUE(text) << text.error().message;
    CostRecords before = parse_costs(*text);
    const auto of_this_mesa = [&](const auto& record) { return record.first.starts_with(mesa() + ","); };
    if (const char* update = std::getenv("DERMIS_UPDATE_COSTS")) {
        if (std::string_view(update) != "missing") std::erase_if(before, of_this_mesa);
        before.insert(now.begin(), now.end());
        ASSERT_TRUE(write_text_file(kRecordedCosts, costs_csv(before)));
        GTEST_SKIP() << "recorded again";
    }
    ASSERT_FALSE(before.empty());
    if (std::ranges::none_of(before, of_this_mesa)) GTEST_SKIP() << "no record of " << mesa();
    for (const std::string& rise : rises(now, before))
        ADD_FAILURE() << rise << "; if that is intended, run with DERMIS_UPDATE_COSTS=1";
}

TEST(RecordedCostsFile, survives_writing_and_a_rise_of_each_column_is_found) {
    const CostRecords before = {{"d,c,t,p,fragment", {10, 20, 0, 8, 99}}};
    CostRecords now = parse_costs(costs_csv(before));
    EXPECT_EQ(costs_csv(now), costs_csv(before));
    EXPECT_TRUE(rises(now, before).empty());
    for (uint64_t CostRecord::*column :
         {&CostRecord::instructions, &CostRecord::vgprs, &CostRecord::spilled}) {
        now = before;
        ++(now.begin()->second.*column);
        EXPECT_EQ(rises(now, before).size(), 1u);
    }
    EXPECT_EQ(rises({{"d,c,new,p,fragment", {}}}, before).size(), 1u);
}

TEST_F(RecordedCosts, another_device_says_the_same_of_the_same_shaders) {
    const std::string first = costs_csv(measure());
    SetUp();
    EXPECT_EQ(costs_csv(measure()), first);
}
