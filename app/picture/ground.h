// The background of a picture: a choice of the window and of exports.
#pragma once

#include "render/scene/frame.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace ramus::app {

enum class Ground : std::uint8_t { kDark, kGrey, kWhite, kTransparent };
struct GroundRow {
    Ground ground;
    std::string_view key;
    const char* label;
};
inline constexpr std::array<GroundRow, 4> kGrounds{{{Ground::kDark, "dark", "Dark"},
                                                    {Ground::kGrey, "grey", "Grey"},
                                                    {Ground::kWhite, "white", "White"},
                                                    {Ground::kTransparent, "transparent", "Transparent"}}};

// Sets background, text colour and strength of fog for the ground. `frame` must have its depth cues.
void put_on(render::Frame& frame, Ground ground);

} // namespace ramus::app
