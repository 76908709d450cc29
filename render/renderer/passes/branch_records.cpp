#include "render/renderer/passes/branch_records.h"

#include "render/scene/colour.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <cmath>

namespace ramus::render {

using namespace record;

namespace {

std::uint16_t linear_word(float srgb) {
    return static_cast<std::uint16_t>(std::lround(65535.0F * linear(std::clamp(srgb, 0.0F, 1.0F))));
}

BranchState state_of(const Frame& frame, std::size_t branch) {
    return branch < frame.states.size() ? frame.states[branch] : BranchState::kNormal;
}

void add_flag(BranchRecord& record, std::uint32_t flag) { record[3] = static_cast<std::uint16_t>(record[3] | flag); }

// Colours, highlights and what is hovered.
std::vector<BranchRecord> plain_records(const Frame& frame, std::size_t count) {
    std::vector<BranchRecord> records(count);
    const bool any_highlight = std::ranges::find(frame.states, BranchState::kHighlighted) != frame.states.end();
    for (std::size_t i = 0; i < count; ++i) {
        const bool highlighted = state_of(frame, i) == BranchState::kHighlighted;
        const glm::vec3 own = i < frame.colours.size() ? frame.colours[i] : frame.appearance.vessel;
        const glm::vec3 colour = highlighted ? frame.appearance.highlight : own;
        records[i] = {linear_word(colour.x), linear_word(colour.y), linear_word(colour.z), 0};
        if (any_highlight) add_flag(records[i], highlighted ? kHighlighted : kCalm);
        if (int(i) == frame.hovered) add_flag(records[i], kHovered);
    }
    for (const int id : frame.hovered_dependents)
        if (id >= 0 && static_cast<std::size_t>(id) < count) add_flag(records[static_cast<std::size_t>(id)], kGlowing);
    return records;
}

} // namespace

BranchRecords::Made BranchRecords::send(const Subject& subject, bool mark_changed) {
    const Frame& frame = subject.frame;
    const Centerlines* lines = subject.scene.lines().shown();
    // Cones and lines may be of branches that the surface does not have yet.
    const auto count = std::max({std::size_t{1}, lines != nullptr ? lines->runs.size() : 0,
                                 subject.has_mesh() ? std::size_t(subject.mesh.shown()->branch_count()) : 0});
    std::vector<BranchRecord> records = plain_records(frame, count);
    Made made;
    for (const int id : frame.selected) {
        const auto index = static_cast<std::size_t>(id);
        if (id < 0 || index >= count || state_of(frame, index) == BranchState::kHidden) continue; // it has no outline
        records[index][3] = static_cast<std::uint16_t>(records[index][3] & ~kCalm);
        add_flag(records[index], kSelected);
        made.any_selected = true;
    }
    for (const LostPart& part : frame.lost) {
        const auto index = static_cast<std::size_t>(part.branch);
        const bool somewhere = part.whole() || (lines != nullptr && lines->at(part.branch, 0.0));
        if (part.branch < 0 || index >= count || !somewhere) continue;
        add_flag(records[index], part.whole() ? kLost : kCut);
        made.any_cut = true;
    }
    std::vector<BranchRecord> marked = records;
    if (mark_changed) {
        made.changed.assign(count, 0);
        for (std::size_t i = 0; i < count; ++i) {
            if (i < records_.size() && records[i] == records_[i]) continue;
            add_flag(marked[i], kChanged);
            made.changed[i] = 1;
        }
    }
    records_ = std::move(records);
    table_.send(marked);
    return made;
}

} // namespace ramus::render
