#include "dermis/view/interface.h"

#include <imgui.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "dermis/image/label.h"
#include "dermis/view/interface_style.h"

namespace dermis::view {
namespace {

constexpr float kFontHeightPx = 15;

struct KeyPair {
    ImGuiKey interface_key;
    int code;
};
constexpr KeyPair kKeys[] = {{ImGuiKey_Tab, kKeyTab.code},
                             {ImGuiKey_LeftArrow, kKeyLeft.code},
                             {ImGuiKey_UpArrow, kKeyUp.code},
                             {ImGuiKey_RightArrow, kKeyRight.code},
                             {ImGuiKey_Home, kKeyHome.code},
                             {ImGuiKey_DownArrow, kKeyDown.code},
                             {ImGuiKey_End, kKeyEnd.code},
                             {ImGuiKey_PageUp, kKeyPageUp.code},
                             {ImGuiKey_Insert, kKeyInsert.code},
                             {ImGuiKey_PageDown, kKeyPageDown.code},
                             {ImGuiKey_Delete, kKeyDelete.code},
                             {ImGuiKey_Backspace, kKeyBackspace.code},
                             {ImGuiKey_Space, kKeySpace.code},
                             {ImGuiKey_Enter, kKeyEnter.code},
                             {ImGuiKey_Escape, kKeyEscape.code},
                             {ImGuiKey_A, 'A'},
                             {ImGuiKey_C, 'C'},
                             {ImGuiKey_V, 'V'},
                             {ImGuiKey_X, 'X'},
                             {ImGuiKey_Y, 'Y'},
                             {ImGuiKey_Z, 'Z'}};

Vec4 unpacked(ImU32 color) {
    const auto channel = [&](int shift) { return float((color >> shift) & 0xFF) / 255; };
    return {channel(IM_COL32_R_SHIFT), channel(IM_COL32_G_SHIFT), channel(IM_COL32_B_SHIFT),
            channel(IM_COL32_A_SHIFT)};
}

}  // namespace

struct Interface::State {
    gpu::Device& device;
    Clipboard clipboard;
    std::string clipboard_text;
    ImGuiContext* context = nullptr;
    std::optional<gpu::Texture> glyphs;
    float scale = 0;

    State(gpu::Device& gpu_device, Clipboard board) : device(gpu_device), clipboard(std::move(board)) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (context) ImGui::DestroyContext(context);
    }
    void take(const Event& event);
};

namespace {

// All commands of a frame as one geometry, whose lists number their vertices from 0 each.
struct Collected {
    std::vector<float> positions, colors;
    std::vector<uint32_t> indices;
    std::vector<gpu::Draw> draws;

    void add(const ImDrawList& list, const gpu::Texture* glyphs) {
        const auto first_vertex = uint32_t(positions.size() / 4);
        const auto first_index = uint32_t(indices.size());
        for (const ImDrawVert& vertex : list.VtxBuffer) {
            positions.insert(positions.end(), {vertex.pos.x, vertex.pos.y, vertex.uv.x, vertex.uv.y});
            const Vec4 color = unpacked(vertex.col);
            colors.insert(colors.end(), {color.x, color.y, color.z, color.w});
        }
        for (const ImDrawIdx index : list.IdxBuffer) indices.push_back(first_vertex + index);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.UserCallback || command.ElemCount == 0) continue;
            const ImVec4 clip = command.ClipRect;
            gpu::Draw draw{.first_index = first_index + command.IdxOffset, .index_count = command.ElemCount};
            draw.textures["glyphs"] = glyphs;
            draw.scissor = gpu::PixelRect{int(clip.x), int(clip.y), int(clip.z) - int(clip.x),
                                          int(clip.w) - int(clip.y)};
            if (draw.scissor->width > 0 && draw.scissor->height > 0) draws.push_back(std::move(draw));
        }
    }
};

}  // namespace

void Interface::State::take(const Event& event) {
    ImGuiIO& io = ImGui::GetIO();
    switch (event.kind) {
        case EventKind::mouse_move:
            io.MousePos = {event.position_px.x, event.position_px.y};
            break;
        case EventKind::mouse_button:
            io.MousePos = {event.position_px.x, event.position_px.y};
            io.MouseDown[size_t(event.button)] = event.pressed;
            break;
        case EventKind::scroll:
            io.MousePos = {event.position_px.x, event.position_px.y};
            io.MouseWheel += event.scroll;
            break;
        case EventKind::key:
            if (event.key.code >= 0 && size_t(event.key.code) < std::size(io.KeysDown))
                io.KeysDown[event.key.code] = event.pressed;
            io.KeyCtrl = event.modifiers.ctrl;
            io.KeyShift = event.modifiers.shift;
            io.KeyAlt = event.modifiers.alt;
            break;
        case EventKind::text:
            io.AddInputCharacter(event.character);
            break;
        case EventKind::drop:
            break;
    }
}

Result<Interface> Interface::create(gpu::Device& device, Clipboard clipboard) {
    auto state = std::make_unique<State>(device, std::move(clipboard));
    state->context = ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = io.LogFilename = nullptr;  // no hidden files
    io.BackendPlatformName = "dermis";
    for (const KeyPair& pair : kKeys) io.KeyMap[pair.interface_key] = pair.code;
    io.GetClipboardTextFn = [](void* user) -> const char* {
        State& self = *static_cast<State*>(user);
        self.clipboard_text = self.clipboard.get();
        return self.clipboard_text.c_str();
    };
    io.SetClipboardTextFn = [](void* user, const char* text) {
        static_cast<State*>(user)->clipboard.set(text);
    };
    io.ClipboardUserData = state.get();
    Interface made(std::move(state));
    DERMIS_TRY(made.set_scale(1));
    return made;
}

Result<void> Interface::set_scale(float scale) {
    if (scale == state_->scale) return {};
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    // Latin, dashes and quotes, arrows, mathematical signs.
    static constexpr ImWchar kRanges[] = {0x20, 0xFF, 0x2010, 0x2026, 0x2190, 0x2193, 0x2212, 0x2265, 0};
    ImFontConfig config;
    config.OversampleH = 2;
    const Result<std::filesystem::path> file = find_font();
    std::error_code ignored;
    if (file && std::filesystem::is_regular_file(*file, ignored)) {
        io.Fonts->AddFontFromFileTTF(file->c_str(), std::round(kFontHeightPx * scale), &config, kRanges);
        io.FontGlobalScale = 1;
    } else {
        io.Fonts->AddFontDefault();
        io.FontGlobalScale = scale;
    }
    unsigned char* texels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&texels, &width, &height);
    gpu::TextureData data{.name = "glyphs", .width = width, .height = height};
    data.bytes.resize(size_t(width) * size_t(height) * 4);
    std::memcpy(data.bytes.data(), texels, data.bytes.size());
    DERMIS_TRY_ASSIGN(gpu::Texture texture, gpu::Texture::upload(state_->device, data));
    state_->glyphs.emplace(std::move(texture));
    io.Fonts->ClearTexData();
    set_style(scale);
    state_->scale = scale;
    return {};
}

float Interface::scale() const {
    return state_->scale;
}

void Interface::begin(std::span<const Event> events, int width, int height, double elapsed_s) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {float(width), float(height)};
    io.DeltaTime = float(std::max(elapsed_s, 1e-4));
    for (const Event& event : events) state_->take(event);
    ImGui::NewFrame();
}

Result<InterfaceDraws> Interface::end() {
    holds_widget_ = ImGui::IsAnyItemActive();
    ImGui::Render();
    const ImDrawData& data = *ImGui::GetDrawData();
    Collected all;
    for (int i = 0; i < data.CmdListsCount; ++i) all.add(*data.CmdLists[i], &*state_->glyphs);
    InterfaceDraws result;
    if (all.draws.empty()) return result;
    const gpu::VertexStream streams[] = {{"position_uv", 4, all.positions}, {"color", 4, all.colors}};
    Result<gpu::Geometry> geometry = gpu::Geometry::streamed("interface", streams, all.indices);
    if (!geometry) return geometry.error();
    result.geometry = std::make_unique<gpu::Geometry>(std::move(*geometry));
    result.draws = std::move(all.draws);
    for (gpu::Draw& draw : result.draws) draw.geometry = result.geometry.get();
    return result;
}

bool Interface::wants_mouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}
bool Interface::wants_keyboard() const {
    return ImGui::GetIO().WantTextInput;
}

Interface::Interface(std::unique_ptr<State> state) : state_(std::move(state)) {}
Interface::~Interface() = default;
Interface::Interface(Interface&&) noexcept = default;
Interface& Interface::operator=(Interface&&) noexcept = default;

}  // namespace dermis::view
