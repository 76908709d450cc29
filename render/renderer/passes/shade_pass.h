// ShadePass: computes light and colour of the resolved surfaces. It has one program for each combination of features,
// built on first use.
#pragma once

#include "render/renderer/passes/glass_pass.h"
#include "render/renderer/passes/plane_tables.h"
#include "render/renderer/passes/scene_tables.h"

#include <array>
#include <functional>
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
    // Puts the frame's planes among what draw() has shaded last, within `region`. Draws no triangle, except that before
    // OpenGL 4.3 the layers of glass are drawn again.
    [[nodiscard]] Result<void> draw_planes(const Subject& subject, ViewTargets& targets, const Region& region);
    // Both, for the whole picture.
    [[nodiscard]] Result<void> draw_all(const Subject& subject, ViewTargets& targets);
    // The caster shades with the same records.
    [[nodiscard]] BranchRecords& records() { return records_; }

private:
    struct Prepared {
        const Fullscreen* light;
        BranchRecords::Made records;
        unsigned of_layers; // the variant for layers of glass
    };
    // Sends everything that the frame's variant needs.
    [[nodiscard]] Result<Prepared> prepare(const Subject& subject, const ViewTargets& targets, bool mark_changed,
                                           unsigned more);
    [[nodiscard]] Result<void> draw_layers(const Subject& subject, ViewTargets& targets, unsigned variant);
    // Calls `draw` for the rows of `region`, band by band where glass is listed in bands.
    void for_bands(const Subject& subject, ViewTargets& targets, const Fullscreen& program, const Region& region,
                   const std::function<void(const Region&)>& draw) const;
    [[nodiscard]] Result<void> guide_planes(const Subject& subject, ViewTargets& targets, bool outlined);
    [[nodiscard]] Result<const Fullscreen*> program(unsigned variant);
    void bind(const ViewTargets& targets) const;

    const FragmentListPass& lists_;
    const LayerPass& layers_;
    Fullscreen background_;
    std::map<unsigned, Fullscreen> programs_;               // by variant
    std::array<Fullscreen, 2 * kMostPlanes> simple_slices_; // by the number of planes; without and with depths
    BranchRecords records_;
    SceneTables tables_;
    PlaneTables planes_;
    Buffer look_block_;
};

// A region that contains all pixels of the branches marked in `changed`: the whole picture if overlays reach beyond the
// branches.
[[nodiscard]] Region region_of(const Subject& subject, const ViewSetup& view, bool has_glass,
                               const std::vector<std::uint8_t>& changed);

} // namespace ramus::render
