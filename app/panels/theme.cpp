#include "app/panels/theme.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace ramus::app::theme {

namespace {

struct Loaded {
    ImFont* small = nullptr;
    ImFont* title = nullptr;
    float scale = 1.0F;
};
Loaded loaded; // for the only ImGui context

// Latin, Greek and Cyrillic file names; dashes, quotes, ellipsis and angle quotes; arrows are not in the font.
constexpr ImWchar kRanges[] = {0x0020, 0x024F, 0x0370, 0x03FF, 0x0400, 0x052F, 0x2010, 0x203A,
                               0x2044, 0x2044, 0x2122, 0x2122, 0x2212, 0x2212, 0};

ImFont* load(const char* file, float size) {
    const std::filesystem::path path = std::filesystem::path(RAMUS_FONT_FOLDER) / file;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return nullptr;
    ImFontConfig config;
    config.OversampleH = 2;
    config.PixelSnapH = true;
    return ImGui::GetIO().Fonts->AddFontFromFileTTF(path.c_str(), std::round(size), &config, kRanges);
}

ImVec4 grey(float value, float alpha = 1.0F) { return {value, value * 1.06F, value * 1.18F, alpha}; }

const Palette kDarkPalette{
    .text = {0.87F, 0.88F, 0.90F, 1.0F},
    .quiet = {0.62F, 0.65F, 0.70F, 1.0F},
    .disabled = {0.57F, 0.60F, 0.65F, 1.0F},
    .accent = {0.36F, 0.80F, 1.00F, 1.0F},
    .accent_dim = {0.17F, 0.38F, 0.50F, 1.0F},
    .highlight = {1.00F, 0.74F, 0.20F, 1.0F},
    .trouble = {1.00F, 0.48F, 0.40F, 1.0F},
    .good = {0.55F, 0.83F, 0.62F, 1.0F},
    .suspect = {1.00F, 0.55F, 0.76F, 1.0F},
    .overlap = {0.95F, 0.94F, 0.55F, 1.0F},
    .gap = {0.62F, 0.78F, 1.00F, 1.0F},
    .trouble_dim = {0.52F, 0.25F, 0.21F, 1.0F},
    .panel = {0.098F, 0.106F, 0.122F, 1.0F},
    .bar = {0.082F, 0.090F, 0.104F, 1.0F},
    .popup = grey(0.115F),
    .line = {0.18F, 0.195F, 0.22F, 1.0F},
    .frame = grey(0.150F),
    .frame_hovered = grey(0.185F),
    .frame_active = grey(0.210F),
    .button = grey(0.165F),
    .button_hovered = grey(0.220F),
    .entry_hovered = grey(0.200F),
    .grab = grey(0.230F),
    .grab_hovered = grey(0.300F),
    .grab_active = grey(0.360F),
    .slider = {0.34F, 0.62F, 0.77F, 1.0F},
    .raised = {1.0F, 1.0F, 1.0F, 0.05F},
};

const Palette kLightPalette{
    .text = {0.10F, 0.11F, 0.13F, 1.0F},
    .quiet = {0.33F, 0.35F, 0.39F, 1.0F},
    .disabled = {0.36F, 0.38F, 0.42F, 1.0F},
    .accent = {0.00F, 0.34F, 0.55F, 1.0F},
    .accent_dim = {0.64F, 0.83F, 0.95F, 1.0F},
    .highlight = {0.50F, 0.29F, 0.00F, 1.0F},
    .trouble = {0.68F, 0.11F, 0.07F, 1.0F},
    .good = {0.05F, 0.38F, 0.18F, 1.0F},
    .suspect = {0.62F, 0.07F, 0.35F, 1.0F},
    .overlap = {0.40F, 0.36F, 0.00F, 1.0F},
    .gap = {0.10F, 0.28F, 0.62F, 1.0F},
    .trouble_dim = {0.97F, 0.74F, 0.70F, 1.0F},
    .panel = {0.955F, 0.960F, 0.970F, 1.0F},
    .bar = {0.915F, 0.922F, 0.935F, 1.0F},
    .popup = {0.985F, 0.988F, 0.992F, 1.0F},
    .line = {0.78F, 0.80F, 0.83F, 1.0F},
    .frame = {0.885F, 0.893F, 0.908F, 1.0F},
    .frame_hovered = {0.850F, 0.860F, 0.880F, 1.0F},
    .frame_active = {0.820F, 0.832F, 0.855F, 1.0F},
    .button = {0.870F, 0.880F, 0.897F, 1.0F},
    .button_hovered = {0.825F, 0.838F, 0.860F, 1.0F},
    .entry_hovered = {0.870F, 0.900F, 0.930F, 1.0F},
    .grab = {0.74F, 0.76F, 0.79F, 1.0F},
    .grab_hovered = {0.66F, 0.68F, 0.72F, 1.0F},
    .grab_active = {0.56F, 0.58F, 0.62F, 1.0F},
    .slider = {0.16F, 0.48F, 0.68F, 1.0F},
    .raised = {0.0F, 0.0F, 0.0F, 0.05F},
};

Kind kind_in_use = Kind::kDark;

void colours(ImGuiStyle& style) {
    const Palette& now = palette_in_use;
    ImVec4* colour = style.Colors;
    kind_in_use == Kind::kDark ? ImGui::StyleColorsDark(&style) : ImGui::StyleColorsLight(&style);
    colour[ImGuiCol_Text] = now.text;
    colour[ImGuiCol_TextDisabled] = now.disabled;
    colour[ImGuiCol_WindowBg] = now.panel;
    colour[ImGuiCol_ChildBg] = kNothing;
    colour[ImGuiCol_PopupBg] = now.popup;
    colour[ImGuiCol_Border] = now.line;
    colour[ImGuiCol_FrameBg] = now.frame;
    colour[ImGuiCol_FrameBgHovered] = now.frame_hovered;
    colour[ImGuiCol_FrameBgActive] = now.frame_active;
    colour[ImGuiCol_TitleBg] = colour[ImGuiCol_TitleBgActive] = now.bar;
    colour[ImGuiCol_MenuBarBg] = now.bar;
    colour[ImGuiCol_ScrollbarBg] = kNothing;
    colour[ImGuiCol_ScrollbarGrab] = now.grab;
    colour[ImGuiCol_ScrollbarGrabHovered] = now.grab_hovered;
    colour[ImGuiCol_ScrollbarGrabActive] = now.grab_active;
    colour[ImGuiCol_CheckMark] = now.accent;
    colour[ImGuiCol_SliderGrab] = now.slider;
    colour[ImGuiCol_SliderGrabActive] = now.accent;
    colour[ImGuiCol_Button] = now.button;
    colour[ImGuiCol_ButtonHovered] = now.button_hovered;
    colour[ImGuiCol_ButtonActive] = now.accent_dim;
    colour[ImGuiCol_Header] = ImVec4(now.accent_dim.x, now.accent_dim.y, now.accent_dim.z, 0.55F);
    colour[ImGuiCol_HeaderHovered] = now.entry_hovered;
    colour[ImGuiCol_HeaderActive] = now.accent_dim;
    colour[ImGuiCol_Separator] = now.line;
    colour[ImGuiCol_TableHeaderBg] = now.panel;
    colour[ImGuiCol_TableBorderStrong] = colour[ImGuiCol_TableBorderLight] = now.line;
    colour[ImGuiCol_TableRowBgAlt] = ImVec4(now.raised.x, now.raised.y, now.raised.z, 0.018F);
    colour[ImGuiCol_PlotHistogram] = now.accent;
    colour[ImGuiCol_NavHighlight] = now.accent;
    colour[ImGuiCol_TextSelectedBg] = now.accent_dim;
    colour[ImGuiCol_ModalWindowDimBg] = ImVec4(0.0F, 0.0F, 0.0F, 0.45F);
}

} // namespace

const Palette& palette(Kind kind) { return kind == Kind::kDark ? kDarkPalette : kLightPalette; }

void use(Kind kind) {
    if (kind == kind_in_use) return;
    kind_in_use = kind;
    palette_in_use = palette(kind);
    colours(ImGui::GetStyle());
}

void apply(float scale) {
    palette_in_use = palette(kind_in_use);
    ImGuiStyle style;
    style.WindowPadding = {14.0F, 12.0F};
    style.FramePadding = {8.0F, 4.0F};
    style.ItemSpacing = {8.0F, 6.0F};
    style.ItemInnerSpacing = {6.0F, 4.0F};
    style.CellPadding = {4.0F, 2.0F};
    style.ScrollbarSize = 11.0F;
    style.GrabMinSize = 10.0F;
    style.WindowRounding = 6.0F;
    style.PopupRounding = 5.0F;
    style.FrameRounding = 4.0F;
    style.GrabRounding = 4.0F;
    style.ScrollbarRounding = 6.0F;
    style.WindowTitleAlign = {0.0F, 0.5F};
    style.WindowMenuButtonPosition = ImGuiDir_None;
    style.WindowMinSize = {16.0F, 16.0F};
    colours(style);
    style.ScaleAllSizes(scale);
    style.WindowBorderSize = style.PopupBorderSize = std::max(1.0F, std::floor(scale));
    ImGui::GetStyle() = style;

    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    loaded = {nullptr, nullptr, scale};
    io.FontGlobalScale = 1.0F;
    if (load("OpenSans-Regular.ttf", kTextSize * scale * 1.15F) != nullptr) {
        loaded.small = load("OpenSans-Regular.ttf", kSmallSize * scale * 1.15F);
        loaded.title = load("OpenSans-Semibold.ttf", kTitleSize * scale * 1.15F);
    } else {
        ImFontConfig config;
        config.SizePixels = std::round(13.0F * scale);
        io.Fonts->AddFontDefault(&config);
    }
}

ImFont* small_font() { return loaded.small; }
ImFont* title_font() { return loaded.title; }
float scale() { return loaded.scale; }

} // namespace ramus::app::theme
