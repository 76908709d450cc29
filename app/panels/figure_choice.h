// FigureChoice: how pictures that are exported shall be, as the dialog has it; the rows of the dialog that choose it.
#pragma once

#include "app/picture/figure_options.h"

#include <array>
#include <filesystem>

namespace ramus::app {

struct FigureChoice {
    // What the window knows when the dialog opens.
    glm::ivec2 window_size{1280, 960}; // of its picture
    float window_text = 1.0F;          // pixels a point there
    bool videos = false;               // can be made

    bool as_window = true;       // its size; else `size`
    glm::ivec2 size{1920, 1080}; // pixels
    Ground ground = Ground::kDark;
    std::array<char, 256> caption{};
    std::array<bool, kFigureOverlays.size()> overlays = usual_overlays();
    int supersample = 1;
    int pictures = kUsualTurntable, rate = 30; // of a turntable
    bool whole = true;                         // likewise

    [[nodiscard]] static std::array<bool, kFigureOverlays.size()> usual_overlays();
    [[nodiscard]] FigureRequest request(const std::filesystem::path& file) const;
};

void draw_figure_choice(FigureChoice& choice, bool turns);

} // namespace ramus::app
