// Options of pictures for papers, slides and videos, as plain values and as words of the command `export`.
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

// Overlays that figures can show.
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
    int supersample = 1; // the picture is drawn this many times larger per side and reduced
    int samples = 16;    // per pixel, if supersample is 1
    int turntable = 0;   // number of pictures in a full turn; 0: one picture
    bool sheet = false;
    bool moving = false;               // drawn as while the view moves
    bool whole = true;                 // the turntable's distance keeps the whole tree in the picture
    int frames_a_second = 30;          // for videos
    std::string caption;               // UTF-8
    std::vector<std::string> overlays; // keys of kFigureOverlays; "none"
    bool overlays_given = false;       // false: the defaults
    std::optional<Ground> ground;      // none: unchanged
    double text_size = 1.0;            // pixels per point of text, scale bar and cube
    bool operator==(const FigureOptions&) const = default;
};

// A figure to write to a file.
struct FigureRequest {
    std::filesystem::path file;     // .png; for a turntable also .mp4
    std::optional<glm::ivec2> size; // pixels; none: of the current picture
    FigureOptions options;
};

// Parses "1600x1200"; fails if it exceeds what can be drawn.
[[nodiscard]] Result<glm::ivec2> size_in(const std::string& text);

// `words`: "--size", "1920x1080", "--caption", ... Fails on unknown words. figure_words() is the inverse.
[[nodiscard]] Result<void> read_figure_words(std::span<const std::string> words, FigureRequest& request);
[[nodiscard]] std::vector<std::string> figure_words(const FigureRequest& request);
inline constexpr const char* kFigureUsage =
    "[--size WxH] [--background dark|grey|white|transparent] [--caption TEXT] [--overlays LIST] [--supersample N] "
    "[--text-size X]; of a turntable [--pictures N] [--rate N] [--as-near]";

} // namespace ramus::app
