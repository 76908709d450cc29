// SceneTables: inputs of shade.frag about lesions, margins, scales, cuts and context, as a uniform block and small
// textures. Features that a frame does not use cost nothing.
#pragma once

#include "render/renderer/scene_on_card.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ramus::render {

class SceneTables {
public:
    void make();
    void release(); // releases everything but the block
    // Features that the shading of this frame needs.
    struct Needs {
        bool margins = false, scale = false, values = false, context = false;
    };
    // Sends and binds everything.
    Needs send(const Subject& subject);

private:
    Buffer block_;
    TexelTable lesions_{GL_RGBA32F}, cuts_{GL_RGBA32F}, shapes_{GL_RGBA32F};
    Texture ramp_;                              // RGB16F, 8 bytes per colour
    Texture distances_;                         // R32F, 4 bytes per sample
    std::shared_ptr<const DistanceGrid> shown_; // the grid in distances_
};

// BranchRecords: one small record per branch, its colour and state (record_flags.h). Hovering and selecting change
// nothing else.

using BranchRecord = std::array<std::uint16_t, 4>; // linear colour, 65535 is 1; flags

class BranchRecords {
public:
    struct Made {
        bool any_selected = false, any_cut = false;
        std::vector<std::uint8_t> changed; // by branch, if requested
    };
    // Sends the records of the subject's frame. With `mark_changed`, marks the branches whose records differ from
    // before.
    Made send(const Subject& subject, bool mark_changed);
    [[nodiscard]] const std::vector<BranchRecord>& records() const { return records_; }
    [[nodiscard]] GLuint table() const { return table_; }

private:
    std::vector<BranchRecord> records_;
    TexelTable table_{GL_RGBA16UI}; // 8 bytes per branch
};

} // namespace ramus::render
