// ShadePass: light and colour of what was resolved. One program for each combination of what a picture shows, made when
// it is needed first.
#pragma once

#include "render/renderer/passes/glass_pass.h"
#include "render/renderer/passes/scene_tables.h"

#include <map>

namespace ramus::render {

// A rectangle of the picture, in GL's sense of y.
struct Region {
    glm::ivec2 at{0}, size{0};
    [[nodiscard]] glm::ivec2 end() const { return at + size; }
};

class ShadePass {
public:
    // Glass, which it lays over what lies behind, is drawn by `lists` or `layers`, as `resolve` takes them.
    ShadePass(const FragmentListPass& lists, const LayerPass& layers) : lists_(lists), layers_(layers) {}
    [[nodiscard]] Result<void> make();
    void let_go(); // after memory has run out: of what was sent for the last picture

    // All of it, or only branches whose records are others than the last time: the rest stays as it is.
    enum class Extent { kAll, kChanged };
    // Of what `targets` hold; returns what was shaded.
    [[nodiscard]] Result<Region> draw(const Subject& subject, ViewTargets& targets, Extent extent);
    // What the caster shades by.
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

// The part of the picture that branches marked in `changed` can be seen in, or more: all of it where what is drawn over
// the picture reaches beyond them.
[[nodiscard]] Region region_of(const Subject& subject, const ViewSetup& view, bool has_glass,
                               const std::vector<std::uint8_t>& changed);

} // namespace ramus::render
