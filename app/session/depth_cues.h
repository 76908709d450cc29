// What tells near from far in a picture, each by itself: the table that commands, menus, session files and pictures
// read.
#pragma once

#include "render/scene/frame.h"

#include <set>
#include <span>
#include <string>
#include <string_view>

namespace ramus::app {

struct DepthCue {
    std::string_view name;        // in commands and session files
    std::string_view label, help; // in the menu
    float render::Appearance::*strength;
};

[[nodiscard]] std::span<const DepthCue> depth_cues();
[[nodiscard]] const DepthCue* depth_cue_named(std::string_view name); // null: there is none

using DepthCues = std::set<std::string, std::less<>>; // names of those that are on

} // namespace ramus::app
