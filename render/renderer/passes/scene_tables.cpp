#include "render/renderer/passes/scene_tables.h"

#include "render/scene/colour.h"
#include "render/scene/look_data.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ramus::render {

namespace {

Texture distance_texture(const DistanceGrid& grid) {
    Texture texture = make_deep_texture(GL_TEXTURE_3D, GL_R32F, grid.size.x, grid.size.y, grid.size.z);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage3D(texture, 0, 0, 0, 0, grid.size.x, grid.size.y, grid.size.z, GL_RED, GL_FLOAT,
                        grid.values.data());
    set_filter(texture, GL_LINEAR);
    return texture;
}

Texture ramp_texture(const std::vector<glm::vec3>& ramp) {
    Texture texture = created<Texture>(glCreateTextures, GL_TEXTURE_1D);
    glTextureStorage1D(texture, 1, GL_RGB16F, static_cast<GLsizei>(ramp.size()));
    glTextureSubImage1D(texture, 0, 0, static_cast<GLsizei>(ramp.size()), GL_RGB, GL_FLOAT, ramp.data());
    set_filter(texture, GL_LINEAR);
    return texture;
}

std::uint16_t linear_word(float srgb) {
    return static_cast<std::uint16_t>(std::lround(65535.0F * linear(std::clamp(srgb, 0.0F, 1.0F))));
}

BranchState state_of(const Frame& frame, std::size_t branch) {
    return branch < frame.states.size() ? frame.states[branch] : BranchState::kNormal;
}

void add_flag(BranchRecord& record, std::uint32_t flag) { record[3] = static_cast<std::uint16_t>(record[3] | flag); }

// Records with colours, highlights and hovering.
std::vector<BranchRecord> plain_records(const Frame& frame, std::size_t count) {
    std::vector<BranchRecord> records(count);
    const bool any_highlight = std::ranges::find(frame.states, BranchState::kHighlighted) != frame.states.end();
    for (std::size_t i = 0; i < count; ++i) {
        const bool highlighted = state_of(frame, i) == BranchState::kHighlighted;
        const glm::vec3 own = i < frame.colours.size() ? frame.colours[i] : frame.appearance.vessel;
        const glm::vec3 colour = highlighted ? frame.appearance.highlight : own;
        records[i] = {linear_word(colour.x), linear_word(colour.y), linear_word(colour.z), 0};
        if (any_highlight) add_flag(records[i], highlighted ? record::kHighlighted : record::kCalm);
        if (int(i) == frame.hovered) add_flag(records[i], record::kHovered);
    }
    for (const int id : frame.hovered_dependents)
        if (id >= 0 && static_cast<std::size_t>(id) < count)
            add_flag(records[static_cast<std::size_t>(id)], record::kGlowing);
    return records;
}

} // namespace

void SceneTables::make() { block_ = make_buffer(sizeof(SceneBlock), nullptr, GL_DYNAMIC_STORAGE_BIT); }

void SceneTables::release() {
    Buffer block = std::move(block_);
    *this = {};
    block_ = std::move(block);
}

SceneTables::Needs SceneTables::send(const Subject& subject) {
    const Frame& frame = subject.frame;
    GpuLines& lines = subject.scene.lines();
    LookData data = look_data_of(frame, lines.shown(), eye_matrix(frame.camera));
    const bool scale = data.block.scale.w > 0.0F;
    const Needs needs{data.block.counts.z > 0.0F, scale, scale && frame.scale.value == ColourScale::Value::kSurface,
                      !data.shapes.empty()};
    if (needs.margins) {
        lesions_.send(data.lesions);
        glBindTextureUnit(kUnitLesions, lesions_);
    }
    if (data.block.counts.w > 0.0F) {
        const auto& distances = frame.lesions.distances;
        if (shown_ != distances) distances_ = distance_texture(*distances);
        shown_ = distances;
        glBindTextureUnit(kUnitDistances, distances_);
    }
    if (lines.shown() != nullptr) lines.whole().bind();
    if (needs.scale) {
        if (frame.scale.value == ColourScale::Value::kOfLines) lines.bind_list(frame.scale.list);
        ramp_ = ramp_texture(frame.scale.ramp);
        glBindTextureUnit(kUnitRamp, ramp_);
    }
    cuts_.send(data.cuts);
    if (!data.cuts.empty()) glBindTextureUnit(kUnitCuts, cuts_);
    shapes_.send(data.shapes);
    glBindTextureUnit(kUnitShapes, shapes_);
    glNamedBufferSubData(block_, 0, sizeof data.block, &data.block);
    glBindBufferBase(GL_UNIFORM_BUFFER, kBlockScene, block_);
    return needs;
}

BranchRecords::Made BranchRecords::send(const Subject& subject, bool mark_changed) {
    const Frame& frame = subject.frame;
    const Centerlines* lines = subject.scene.lines().shown();
    // Cones and lines may have branches that the surface lacks so far.
    const auto count = std::max({std::size_t{1}, lines != nullptr ? lines->runs.size() : 0,
                                 subject.has_mesh() ? std::size_t(subject.mesh.shown()->branch_count()) : 0});
    std::vector<BranchRecord> records = plain_records(frame, count);
    Made made;
    for (const int id : frame.selected) {
        const auto index = static_cast<std::size_t>(id);
        if (id < 0 || index >= count || state_of(frame, index) == BranchState::kHidden) continue; // it has no outline
        records[index][3] = static_cast<std::uint16_t>(records[index][3] & ~record::kCalm);
        add_flag(records[index], record::kSelected);
        made.any_selected = true;
    }
    for (const LostPart& part : frame.lost) {
        const auto index = static_cast<std::size_t>(part.branch);
        const bool somewhere = part.whole() || (lines != nullptr && lines->at(part.branch, 0.0));
        if (part.branch < 0 || index >= count || !somewhere) continue;
        add_flag(records[index], part.whole() ? record::kLost : record::kCut);
        made.any_cut = true;
    }
    std::vector<BranchRecord> marked = records;
    if (mark_changed) {
        made.changed.assign(count, 0);
        for (std::size_t i = 0; i < count; ++i) {
            if (i < records_.size() && records[i] == records_[i]) continue;
            add_flag(marked[i], record::kChanged);
            made.changed[i] = 1;
        }
    }
    records_ = std::move(records);
    table_.send(marked);
    return made;
}

} // namespace ramus::render
