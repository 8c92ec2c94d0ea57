#include "engines/drawn_head/drawing.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "dermis/image/io.h"
#include "dermis/image/resample.h"

namespace dermis::drawn_head {

namespace fs = std::filesystem;

int run(int count, char** values, const std::string& name, Result<Image> (*draw)(const Settings&)) {
    Settings settings;
    std::vector<std::string> files;
    for (int i = 1; i < count; ++i) {
        const std::string word = values[i], next = i + 1 < count ? values[i + 1] : "";
        if (word == "--gain" || word == "--lambert") {
            (word == "--gain" ? settings.gain : settings.lambert) = true;
        } else if (word == "--side" || word == "--points") {
            (word == "--side" ? settings.side : settings.points) = std::atoi(next.c_str());
            ++i;
        } else if (word == "--mistake" || word == "--clip") {
            (word == "--clip" ? settings.clip : settings.mistake) = next;
            ++i;
        } else if (word == "--time") {
            settings.time_s = std::atof(next.c_str());
            ++i;
        } else {
            files.push_back(word);
        }
    }
    if (files.size() != 2 || settings.side < 1 || settings.points < 1) {
        std::fprintf(stderr, "%s: give a package and a picture: %s PACKAGE picture.exr\n", name.c_str(),
                     name.c_str());
        return 2;
    }
    settings.package = files[0];
    const auto picture = draw(settings);
    const auto written = picture ? write_image(files[1], *picture) : Result<void>(picture.error());
    if (written) return 0;
    std::fprintf(stderr, "%s: %s\n", name.c_str(), written.error().message.c_str());
    return 1;
}

Result<std::vector<uint32_t>> compiled_hlsl(const fs::path& scratch, const std::string& name,
                                            const std::string& text,
                                            const std::vector<std::string>& options) {
    const fs::path source = scratch / "pass.hlsl", binary = scratch / "pass.spv", log = scratch / "log.txt";
    DERMIS_TRY(write_text_file(source, text));
    std::vector<std::string> command = {"glslc",
                                        "-O",
                                        "-g",
                                        "-x",
                                        "hlsl",
                                        "-fentry-point=main",
                                        "-fauto-bind-uniforms",
                                        "-fauto-map-locations"};
    command.push_back(name.ends_with(".vert") ? "-fshader-stage=vertex" : "-fshader-stage=fragment");
    command.insert(command.end(), options.begin(), options.end());
    command.insert(command.end(), {source.string(), "-o", binary.string()});
    if (run_program(command, log) != 0) {
        DERMIS_TRY_ASSIGN(const std::string said, read_text_file(log));
        return Error{name + ": " + said};
    }
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> bytes, read_file(binary));
    std::vector<uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

Result<gpu::TextureData> imported_picture(const fs::path& path, bool srgb, bool has_mips,
                                          bool first_row_last) {
    DERMIS_TRY_ASSIGN(const LoadedImage loaded, read_image(path, dermis::ImageUse::data));
    const Image& image = loaded.image;
    const bool is_float = path.extension() == ".exr";
    gpu::TextureData data = {.name = path.filename().string(),
                             .format = is_float ? ImageFormat::rgba16f : ImageFormat::rgba8,
                             .srgb = !is_float && srgb,
                             .width = image.width,
                             .height = image.height};
    Image four(image.width, image.height, 4, is_float ? PixelFormat::f16 : PixelFormat::u8);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 4; ++c)
                four.set(x, first_row_last ? image.height - 1 - y : y, c,
                         c < image.channels ? image.at(x, y, c) : 1);
    // As an importer on the CPU: levels that a device draws from each other round at every step.
    four.encoding = data.srgb ? Encoding::srgb : Encoding::linear;
    const std::vector<Image> levels = has_mips ? mip_chain(four) : std::vector{four};
    data.mips = int(levels.size());
    for (const Image& level : levels)
        data.bytes.insert(data.bytes.end(), level.bytes.begin(), level.bytes.end());
    return data;
}

gpu::TextureData standard_picture(const std::string& name) {
    const uint8_t all = name == "black" ? 0 : 255, side = name == "bump" ? 128 : all;
    gpu::TextureData data = {.name = name};
    for (const uint8_t value : {side, side, all, uint8_t(255)}) data.bytes.push_back(std::byte(value));
    return data;
}

gpu::Values view_values(const View& view) {
    const auto row = [](Vec3 direction, float offset) {
        return Vec4{direction.x, direction.y, direction.z, offset};
    };
    const float scale = 1 / std::tan(0.5f * view.vertical_fov_rad), depth = view.far / (view.far - view.near);
    const Vec3 right = view.right * scale, down = view.up * -scale;  // Vulkan's y is down
    return {
        {"stub_clip_0", row(right, -dot(right, view.eye))},
        {"stub_clip_1", row(down, -dot(down, view.eye))},
        {"stub_clip_2", row(view.forward * depth, -dot(view.forward, view.eye) * depth - view.near * depth)},
        {"stub_clip_3", row(view.forward, -dot(view.forward, view.eye))},
        {"stub_eye", row(view.eye, 1)}};
}

PassList head_pass(const nlohmann::json& background) {
    const Pass pass = {
        .name = "lit",
        .kind = PassKind::geometry_screen,
        .shader = "head.frag",
        .vertex_shader = "head.vert",
        .colors = {{.image = "radiance", .clear = {background[0], background[1], background[2], 1}}},
        .depth = DepthTarget{.image = "depth"},
        .cull = Cull::back};
    return {.images = {{.name = "depth", .format = ImageFormat::depth32f},
                       {.name = "radiance", .format = ImageFormat::rgba32f}},
            .passes = {pass}};
}

Result<Image> drawn(gpu::Device& device, const gpu::ShaderSource& shaders, const PassList& list,
                    gpu::FrameInputs frame, const Settings& settings) {
    frame.width = frame.height = settings.side * settings.points;
    DERMIS_TRY_ASSIGN(gpu::Executor executor, gpu::Executor::create(device, shaders));
    DERMIS_TRY(executor.run(list, frame));
    DERMIS_TRY_ASSIGN(const Image radiance, executor.read("radiance"));
    return resize(radiance, settings.side, settings.side);
}

}  // namespace dermis::drawn_head
