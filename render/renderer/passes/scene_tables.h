// SceneTables: what shade.frag knows of lesions, margins, scales, cuts and context: a uniform block and small textures.
// What a plain tree does not need costs it nothing.
#pragma once

#include "render/renderer/scene_on_card.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ramus::render {

class SceneTables {
public:
    void make();
    void let_go(); // of all but the block
    // What the shading of this frame has to do beside a plain tree's.
    struct Needs {
        bool margins = false, scale = false, values = false, context = false;
    };
    // Sends and binds all of it.
    Needs send(const Subject& subject);

private:
    Buffer block_;
    TexelTable lesions_{GL_RGBA32F}, cuts_{GL_RGBA32F}, context_{GL_RGBA32F};
    Texture ramp_;                              // RGB16F, 8 bytes a colour
    Texture distances_;                         // R32F, 4 bytes a sample
    std::shared_ptr<const DistanceGrid> shown_; // in distances_
};

// BranchRecords: one small record a branch, its colour and how it is seen (record_flags.h); nothing else changes when
// the user points at things.

using BranchRecord = std::array<std::uint16_t, 4>; // linear colour of 65535, flags

class BranchRecords {
public:
    struct Made {
        bool any_selected = false, any_cut = false;
        std::vector<std::uint8_t> changed; // by branch, where that was asked for
    };
    // Those of the subject's frame; with `mark_changed` branches are marked whose record is another than before.
    Made send(const Subject& subject, bool mark_changed);
    [[nodiscard]] const std::vector<BranchRecord>& records() const { return records_; }
    [[nodiscard]] GLuint table() const { return table_; }

private:
    std::vector<BranchRecord> records_;
    TexelTable table_{GL_RGBA16UI}; // 8 bytes a branch
};

} // namespace ramus::render
