// ShadePass: computes light and colour of the resolved surfaces. It has one program for each combination of features,
// built on first use.
#pragma once

#include "render/renderer/passes/glass_pass.h"
#include "render/renderer/passes/scene_tables.h"

#include <map>

namespace ramus::render {

// A rectangle of the picture, y from below.
struct Region {
    glm::ivec2 at{0}, size{0};
    [[nodiscard]] glm::ivec2 end() const { return at + size; }
};

class ShadePass {
public:
    // `lists` or `layers` provide the glass; both must outlive the pass.
    ShadePass(const FragmentListPass& lists, const LayerPass& layers) : lists_(lists), layers_(layers) {}
    [[nodiscard]] Result<void> make();
    void release(); // after running out of memory: releases what was sent for the last picture

    // kAll: the whole picture. kChanged: only branches whose records changed since the last call.
    enum class Extent { kAll, kChanged };
    // Shades the contents of `targets`; returns the region that was shaded.
    [[nodiscard]] Result<Region> draw(const Subject& subject, ViewTargets& targets, Extent extent);
    // The caster shades with the same records.
    [[nodiscard]] BranchRecords& records() { return records_; }

private:
    [[nodiscard]] Result<const Fullscreen*> program(unsigned variant);
    void draw_rows(const Fullscreen& program, const ViewTargets& targets, const Region& region,
                   Fullscreen::Pixels pixels) const;
    void bind(const ViewTargets& targets) const;

    const FragmentListPass& lists_;
    const LayerPass& layers_;
    Fullscreen background_;
    std::map<unsigned, Fullscreen> programs_; // by variant
    BranchRecords records_;
    SceneTables tables_;
    Buffer look_block_;
};

// A region that contains all pixels of the branches marked in `changed`: the whole picture if overlays reach beyond the
// branches.
[[nodiscard]] Region region_of(const Subject& subject, const ViewSetup& view, bool has_glass,
                               const std::vector<std::uint8_t>& changed);

} // namespace ramus::render
