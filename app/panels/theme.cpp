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
Loaded loaded; // of the one ImGui context there is

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

void colours(ImGuiStyle& style) {
    const auto grey = [](float value, float alpha = 1.0F) {
        return ImVec4(value, value * 1.06F, value * 1.18F, alpha);
    };
    ImVec4* colour = style.Colors;
    ImGui::StyleColorsDark(&style);
    colour[ImGuiCol_Text] = kText;
    colour[ImGuiCol_TextDisabled] = ImVec4(0.42F, 0.45F, 0.50F, 1.0F);
    colour[ImGuiCol_WindowBg] = kPanel;
    colour[ImGuiCol_ChildBg] = ImVec4(0.0F, 0.0F, 0.0F, 0.0F);
    colour[ImGuiCol_PopupBg] = grey(0.115F);
    colour[ImGuiCol_Border] = kLine;
    colour[ImGuiCol_FrameBg] = grey(0.150F);
    colour[ImGuiCol_FrameBgHovered] = grey(0.185F);
    colour[ImGuiCol_FrameBgActive] = grey(0.210F);
    colour[ImGuiCol_TitleBg] = colour[ImGuiCol_TitleBgActive] = kBar;
    colour[ImGuiCol_MenuBarBg] = kBar;
    colour[ImGuiCol_ScrollbarBg] = ImVec4(0.0F, 0.0F, 0.0F, 0.0F);
    colour[ImGuiCol_ScrollbarGrab] = grey(0.230F);
    colour[ImGuiCol_ScrollbarGrabHovered] = grey(0.300F);
    colour[ImGuiCol_ScrollbarGrabActive] = grey(0.360F);
    colour[ImGuiCol_CheckMark] = kAccent;
    colour[ImGuiCol_SliderGrab] = ImVec4(0.34F, 0.62F, 0.77F, 1.0F);
    colour[ImGuiCol_SliderGrabActive] = kAccent;
    colour[ImGuiCol_Button] = grey(0.165F);
    colour[ImGuiCol_ButtonHovered] = grey(0.220F);
    colour[ImGuiCol_ButtonActive] = kAccentDim;
    colour[ImGuiCol_Header] = ImVec4(kAccentDim.x, kAccentDim.y, kAccentDim.z, 0.55F);
    colour[ImGuiCol_HeaderHovered] = grey(0.200F);
    colour[ImGuiCol_HeaderActive] = kAccentDim;
    colour[ImGuiCol_Separator] = kLine;
    colour[ImGuiCol_TableHeaderBg] = kPanel;
    colour[ImGuiCol_TableBorderStrong] = colour[ImGuiCol_TableBorderLight] = kLine;
    colour[ImGuiCol_TableRowBgAlt] = ImVec4(1.0F, 1.0F, 1.0F, 0.018F);
    colour[ImGuiCol_PlotHistogram] = kAccent;
    colour[ImGuiCol_NavHighlight] = kAccent;
    colour[ImGuiCol_TextSelectedBg] = kAccentDim;
    colour[ImGuiCol_ModalWindowDimBg] = ImVec4(0.0F, 0.0F, 0.0F, 0.45F);
}

} // namespace

void apply(float scale) {
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
