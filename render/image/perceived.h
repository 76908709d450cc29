// How different two pictures are to an eye: colours as they are told apart, after the blur of seeing. What golden
// pictures are held to: a rasteriser that rounds an edge otherwise shows nothing, a wrong tint does.
#pragma once

#include "render/image/image.h"

#include <cstdint>

namespace ramus::render {

// A pixel of a desktop screen, 0.27 mm, from 60 cm.
inline constexpr double kPixelsPerDegree = 39.0;

// Of two colours next to each other, in units of CIE 1976 L*a*b* (Mahy, Van Eycken and Oosterlinck, 1994).
inline constexpr double kJustNoticeable = 2.3;

struct PerceivedDifference {
    std::uint64_t pixels = 0;         // of the picture
    std::uint64_t noticeable = 0;     // that differ by more than kJustNoticeable
    double mean = 0.0, largest = 0.0; // distances in L*a*b*
    [[nodiscard]] double fraction() const { return pixels == 0 ? 0.0 : double(noticeable) / double(pixels); }
};

// S-CIELAB (Zhang and Wandell, 1997): brightness, red against green and blue against yellow are blurred as the eye does
// at that many pixels a degree, each by itself, and then compared in L*a*b*, D65. Of brightness the widest of its three
// blurs, which takes a tenth over four degrees, is left out. Transparent pictures are seen over middle grey. Fails when
// the sizes differ.
[[nodiscard]] Result<PerceivedDifference> perceived_difference(const Image& actual, const Image& reference,
                                                               double pixels_per_degree = kPixelsPerDegree);

} // namespace ramus::render
