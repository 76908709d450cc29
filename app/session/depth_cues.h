// Depth cues (visual hints about near and far): the table that commands, menus, session files and pictures read.
#pragma once

#include "render/scene/frame.h"

#include <span>
#include <string_view>

namespace ramus::app {

struct DepthCue {
    std::string_view name;        // in commands and session files
    std::string_view label, help; // in the menu
    float render::Appearance::*strength;
};

[[nodiscard]] std::span<const DepthCue> depth_cues();                 // the first two are on in a new session
[[nodiscard]] const DepthCue* depth_cue_named(std::string_view name); // null: no such cue

// The set of active depth cues.
class DepthCues {
public:
    [[nodiscard]] bool has(const DepthCue& cue) const { return (bits_ >> place_of(cue) & 1U) != 0; }
    void set(const DepthCue& cue, bool on) {
        bits_ = on ? bits_ | 1U << place_of(cue) : bits_ & ~(1U << place_of(cue));
    }
    void clear() { bits_ = 0; }
    bool operator==(const DepthCues&) const = default;

private:
    static unsigned place_of(const DepthCue& cue) { return static_cast<unsigned>(&cue - depth_cues().data()); }
    unsigned bits_ = 3; // the table's first two
};

} // namespace ramus::app
