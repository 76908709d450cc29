// FigureChoice: the choices for exported pictures in the export dialog, and the rows that draw them.
#pragma once

#include "app/picture/figure_options.h"

#include <array>
#include <filesystem>

namespace ramus::app {

struct FigureChoice {
    // Set by the window when the dialog opens.
    glm::ivec2 window_size{1280, 960}; // size of its picture
    float window_text = 1.0F;          // pixels per point in the window
    bool videos = false;               // videos can be made

    bool as_window = true;       // size as the window; false: `size`
    glm::ivec2 size{1920, 1080}; // pixels
    Ground ground = Ground::kDark;
    std::array<char, 256> caption{};
    std::array<bool, kFigureOverlays.size()> overlays = usual_overlays();
    int supersample = 1;
    int pictures = kUsualTurntable, rate = 30; // for turntables
    bool whole = true;                         // for turntables

    [[nodiscard]] static std::array<bool, kFigureOverlays.size()> usual_overlays();
    [[nodiscard]] FigureRequest request(const std::filesystem::path& file) const;
};

void draw_figure_choice(FigureChoice& choice, bool turns);

} // namespace ramus::app
