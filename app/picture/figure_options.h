// What a picture for a paper, a slide or a video shall be, beside the document: plain values, and the words that say
// them in the command `export`.
#pragma once

#include "app/picture/ground.h"
#include "core/base/error.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

// What may lie over the tree.
struct OverlayRow {
    std::string_view key;
    const char* label;
    bool usual;
};
inline constexpr std::array<OverlayRow, 4> kFigureOverlays{{{"cube", "Cube", true},
                                                            {"scale", "Scale bar", true},
                                                            {"legend", "Legend", true},
                                                            {"letters", "Letters at the edges", false}}};

inline constexpr int kMostSupersampling = 8;
inline constexpr int kMostTurntable = 9999, kUsualTurntable = 120; // pictures
inline constexpr double kLeastTextSize = 0.25, kMostTextSize = 16.0;

struct FigureOptions {
    int supersample = 1; // pixels a side that become one
    int samples = 16;    // of each pixel, where nothing is drawn larger
    int turntable = 0;   // pictures once around; 0: one picture
    bool sheet = false;
    bool moving = false;               // as while the view moves
    bool whole = true;                 // a turntable comes so near that the tree stays whole
    int frames_a_second = 30;          // of a video
    std::string caption;               // UTF-8
    std::vector<std::string> overlays; // of kFigureOverlays; "none"
    bool overlays_given = false;       // else the usual ones
    std::optional<Ground> ground;      // none: as without
    double text_size = 1.0;            // pixels a point of words, bar and cube
    bool operator==(const FigureOptions&) const = default;
};

// A file with it.
struct FigureRequest {
    std::filesystem::path file;     // .png; of a turntable also .mp4
    std::optional<glm::ivec2> size; // pixels; none: of the picture that there is
    FigureOptions options;
};

// "1600x1200", within what can be drawn.
[[nodiscard]] Result<glm::ivec2> size_in(const std::string& text);

// `words`: "--size", "1920x1080", "--caption", ... Fails on what it does not know. `figure_words` of what was read are
// read the same.
[[nodiscard]] Result<void> read_figure_words(std::span<const std::string> words, FigureRequest& request);
[[nodiscard]] std::vector<std::string> figure_words(const FigureRequest& request);
inline constexpr const char* kFigureUsage =
    "[--size WxH] [--background dark|grey|white|transparent] [--caption TEXT] [--overlays LIST] [--supersample N] "
    "[--text-size X]; of a turntable [--pictures N] [--rate N] [--as-near]";

} // namespace ramus::app
