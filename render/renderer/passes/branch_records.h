// BranchRecords: one small record a branch, its colour and how it is seen (record_flags.h); nothing else changes when
// the user points at things.
#pragma once

#include "render/renderer/scene_on_card.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ramus::render {

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
