// Colours of territories that also people with red-green blindness tell apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ramus::app {

// sRGB, of the n-th territory. The first eight are those of Okabe & Ito (2008), without black, and a grey; after those
// they repeat, darker each time.
[[nodiscard]] constexpr std::array<std::uint8_t, 3> territory_colour(std::size_t n) {
    constexpr std::array<std::array<std::uint8_t, 3>, 8> kColours{{{230, 159, 0},
                                                                   {86, 180, 233},
                                                                   {0, 158, 115},
                                                                   {240, 228, 66},
                                                                   {0, 114, 178},
                                                                   {213, 94, 0},
                                                                   {204, 121, 167},
                                                                   {150, 150, 150}}};
    std::array<std::uint8_t, 3> colour = kColours[n % kColours.size()];
    const std::size_t round = n / kColours.size() % 4;
    for (std::uint8_t& channel : colour) channel = static_cast<std::uint8_t>(channel * (8 - round) / 8);
    return colour;
}

} // namespace ramus::app
