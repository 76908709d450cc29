// Perceived difference of two pictures: colour differences after the blur of the eye. Golden pictures are tested with
// it: an edge rounded differently by another rasteriser does not count, a wrong tint does.
#pragma once

#include "render/image/image.h"

#include <cstdint>

namespace ramus::render {

// A pixel of a desktop screen, 0.27 mm, from 60 cm.
inline constexpr double kPixelsPerDegree = 39.0;

// Just noticeable difference of adjacent colours in CIE 1976 L*a*b* (Mahy, Van Eycken and Oosterlinck, 1994).
inline constexpr double kJustNoticeable = 2.3;

struct PerceivedDifference {
    std::uint64_t pixels = 0;         // in total
    std::uint64_t noticeable = 0;     // pixels that differ by more than kJustNoticeable
    double mean = 0.0, largest = 0.0; // distances in L*a*b*
    [[nodiscard]] double fraction() const { return pixels == 0 ? 0.0 : double(noticeable) / double(pixels); }
};

// S-CIELAB (Zhang and Wandell, 1997): luminance, red-green and blue-yellow are each blurred for the given number of
// pixels per degree and compared in L*a*b*, D65. Omits the widest of the three blurs of luminance (weight one tenth,
// four degrees). Transparent pictures are composed over middle grey. Fails if the sizes differ.
[[nodiscard]] Result<PerceivedDifference> perceived_difference(const Image& actual, const Image& reference,
                                                               double pixels_per_degree = kPixelsPerDegree);

} // namespace ramus::render
