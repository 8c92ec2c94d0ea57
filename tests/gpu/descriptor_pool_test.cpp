// Descriptor sets from a pool, for devices without VK_KHR_push_descriptor.
// tests/render/pooled_pictures_test.cpp draws every technique with them.

#include "dermis/gpu/device_state.h"
#include "test_shaders.h"

namespace dermis::gpu {
namespace {

using ::testing::ElementsAre;

class DescriptorPoolTest : public GpuTest {
  protected:
    static void SetUpTestSuite() { open_device({.validation = true, .pooled_descriptors = true}); }
};

class PushDescriptorTest : public GpuTest {};

const std::string kTinted = kHead + R"(
uniform texture2D map;
uniform sampler nearest_clamp;
layout(scalar) uniform Material { float gain; };
layout(location = 0) out vec4 color;
void main() { color = texture(sampler2D(map, nearest_clamp), vec2(0.5)) * gain; })";

ShaderSource tinted_shaders() {
    return basic_shaders({{"tinted.frag", kTinted}});
}

Texture one_float(Device& device, float value) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    Result<Texture> texture = Texture::upload(
        device, {.name = "one float", .format = ImageFormat::r32f, .bytes = {bytes.begin(), bytes.end()}});
    EXPECT_TRUE(texture) << texture.error().message;
    return std::move(*texture);
}

// Texel i of a row gets map i times gain i, each by a draw of its own.
struct TintedRow {
    std::vector<Texture> maps;
    std::vector<Geometry> quads;
    FrameInputs inputs;

    TintedRow(Device& device, int texels) : inputs{.width = texels, .height = 1} {
        for (int i = 0; i < texels; ++i) {
            const float left = -1 + 2 * float(i) / float(texels), right = left + 2 / float(texels);
            maps.push_back(one_float(device, float(i + 1)));
            quads.push_back(clip_mesh(device, {left, -1, 0, right, -1, 0, left, 1, 0,  //
                                               left, 1, 0, right, -1, 0, right, 1, 0}));
        }
        for (int i = 0; i < texels; ++i) {
            Draw draw = draw_of(quads[size_t(i)], 6);
            draw.textures["map"] = &maps[size_t(i)];
            draw.values["gain"] = float(10 * i);
            inputs.draws.push_back(draw);
        }
    }
};

PassList tinted_list() {
    return {.images = {{.name = "out", .format = ImageFormat::r32f}},
            .passes = {{.name = "tinted",
                        .kind = PassKind::geometry_screen,
                        .shader = "tinted.frag",
                        .colors = {{.image = "out"}}}}};
}

void submit(Executor& executor, const FrameInputs& inputs, int times) {
    for (int i = 0; i < times; ++i) {
        const Result<uint64_t> frame = executor.submit(tinted_list(), inputs);
        ASSERT_TRUE(frame) << frame.error().message;
    }
}

// Counts the sets of each pool while it lives. Drivers need not refuse a set too many, and lavapipe does not.
class CountedPools {
  public:
    explicit CountedPools(VolkDeviceTable& table) : table_(table) {
        real_ = table;
        pools_.clear();
        table.vkCreateDescriptorPool = [](VkDevice device, const VkDescriptorPoolCreateInfo* info,
                                          const VkAllocationCallbacks* callbacks, VkDescriptorPool* pool) {
            const VkResult result = real_.vkCreateDescriptorPool(device, info, callbacks, pool);
            pools_[*pool] = {.room = info->maxSets};
            return result;
        };
        table.vkResetDescriptorPool = [](VkDevice device, VkDescriptorPool pool, VkFlags flags) {
            pools_[pool].sets = 0;
            return real_.vkResetDescriptorPool(device, pool, flags);
        };
        table.vkAllocateDescriptorSets = [](VkDevice device, const VkDescriptorSetAllocateInfo* info,
                                            VkDescriptorSet* sets) {
            Pool& pool = pools_[info->descriptorPool];
            pool.sets += info->descriptorSetCount;
            pool.most = std::max(pool.most, pool.sets);
            return real_.vkAllocateDescriptorSets(device, info, sets);
        };
    }
    ~CountedPools() { table_ = real_; }
    CountedPools(const CountedPools&) = delete;
    CountedPools& operator=(const CountedPools&) = delete;

    struct Pool {
        uint32_t room = 0, sets = 0, most = 0;
    };
    [[nodiscard]] static const std::map<VkDescriptorPool, Pool>& pools() { return pools_; }

  private:
    VolkDeviceTable& table_;
    inline static VolkDeviceTable real_;
    inline static std::map<VkDescriptorPool, Pool> pools_;
};

// The sum of `count` textures, each with a binding of its own.
std::string sum_shader(int count) {
    std::string declared, sum = "0";
    for (int i = 0; i < count; ++i) {
        const std::string name = "map_" + std::to_string(i);
        declared += "uniform texture2D " + name + ";\n";
        sum += " + texelFetch(" + name + ", ivec2(0), 0).r";
    }
    return kHead + "#extension GL_EXT_samplerless_texture_functions : require\n" + declared +
           "layout(location = 0) out float color;\nvoid main() { color = " + sum + "; }";
}

void expect_sum_of_textures(Executor& executor, Device& device, int count) {
    std::vector<Texture> textures;
    FrameInputs inputs = {.width = 1, .height = 1};
    for (int i = 0; i < count; ++i) textures.push_back(one_float(device, float(1 + i)));
    for (int i = 0; i < count; ++i) inputs.textures["map_" + std::to_string(i)] = &textures[size_t(i)];
    const PassList list = {.images = {{.name = "out", .format = ImageFormat::r32f}},
                           .passes = {{.name = "sum", .shader = "sum.frag", .colors = {{.image = "out"}}}}};
    const Result<FrameResult> result = executor.run(list, inputs);
    ASSERT_TRUE(result) << result.error().message;
    const Result<Image> out = executor.read("out");
    ASSERT_TRUE(out) << out.error().message;
    EXPECT_EQ(texel(*out, 0, 0)[0], float(count * (count + 1) / 2));
}

}  // namespace

TEST_F(DescriptorPoolTest, the_device_says_that_it_pushes_none) {
    EXPECT_EQ(device().info().push_descriptors, 0);
    EXPECT_EQ(device().state().context.vk.vkCmdPushDescriptorSetKHR, nullptr);
}

TEST_F(DescriptorPoolTest, each_draw_has_its_own_textures_and_values) {
    Executor executor = make_executor(tinted_shaders());
    const TintedRow row(device(), 3);
    run(executor, tinted_list(), row.inputs);
    const Image out = read(executor, "out");
    for (int x = 0; x < 3; ++x) EXPECT_THAT(texel(out, x, 0), ElementsAre(float((x + 1) * 10 * x)));
}

TEST_F(DescriptorPoolTest, a_pass_without_bindings_needs_no_set) {
    Executor executor = make_executor(basic_shaders());
    run(executor,
        {.images = {{.name = "out", .format = ImageFormat::r32f}},
         .passes = {{.name = "white", .shader = "white.frag", .colors = {{.image = "out"}}}}},
        {.width = 1, .height = 1});
    EXPECT_THAT(texel(read(executor, "out"), 0, 0), ElementsAre(1));
}

TEST_F(DescriptorPoolTest, hundred_frames_make_no_vulkan_object_after_the_first_ones) {
    Executor executor = make_executor(tinted_shaders());
    const TintedRow row(device(), 5);
    submit(executor, row.inputs, int(kFramesInFlight));
    const uint64_t before = device().created_objects();
    submit(executor, row.inputs, 100);
    EXPECT_EQ(device().created_objects(), before);
}

TEST_F(DescriptorPoolTest, a_pool_never_holds_more_sets_than_it_has_room_for) {
    Executor executor = make_executor(tinted_shaders());
    const TintedRow row(device(), 5);
    const CountedPools counted(device().state().context.vk);
    submit(executor, row.inputs, 20);
    ASSERT_EQ(counted.pools().size(), kFramesInFlight);
    for (const auto& [pool, count] : counted.pools()) {
        EXPECT_EQ(count.most, 5u);
        EXPECT_GE(count.room, 5u);
        EXPECT_LE(count.room, 7u);
    }
}

TEST_F(DescriptorPoolTest, pools_grow_with_the_largest_frame_only) {
    Executor executor = make_executor(tinted_shaders());
    const TintedRow small(device(), 2);
    submit(executor, small.inputs, int(kFramesInFlight));
    const uint64_t before = device().created_objects();
    FrameInputs more = small.inputs;  // the same image, so that only pools can be new
    more.draws.assign(40, small.inputs.draws.back());
    submit(executor, more, int(kFramesInFlight));
    EXPECT_EQ(device().created_objects(), before + kFramesInFlight);
    for (int i = 0; i < 10; ++i) {
        submit(executor, small.inputs, 1);
        submit(executor, more, 2);
    }
    EXPECT_EQ(device().created_objects(), before + kFramesInFlight);
}

TEST_F(DescriptorPoolTest, a_pass_may_have_more_bindings_than_a_pushed_set) {
    Executor executor = make_executor(basic_shaders({{"sum.frag", sum_shader(40)}}));
    expect_sum_of_textures(executor, device(), 40);
}

TEST_F(PushDescriptorTest, a_pass_with_too_many_bindings_to_push_has_a_set_from_a_pool) {
    const int most = device().info().push_descriptors;
    if (!most) GTEST_SKIP() << device().info().name << " has no VK_KHR_push_descriptor";
    Executor executor = make_executor(basic_shaders({{"sum.frag", sum_shader(most + 1)}}));
    expect_sum_of_textures(executor, device(), most + 1);
}

}  // namespace dermis::gpu
