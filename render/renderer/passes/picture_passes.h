// From what was lit to the picture: CopyPass brings it there, MeanPass makes it the mean of several views, CastPass has
// the caster make it.
#pragma once

#include "render/caster/caster.h"
#include "render/renderer/passes/shade_pass.h"
#include "render/renderer/targets.h"

namespace ramus::render {

class CopyPass {
public:
    [[nodiscard]] Result<void> make() { return enlarge_.make("enlarge.frag"); }
    // Only `region`, which was shaded: the rest has its overlays already. All of a picture that is enlarged.
    void draw(const ViewSetup& view, const LitTarget& from, const PictureTarget& to, const Region& region) const;

private:
    Fullscreen enlarge_;
};

struct MeanTarget {
    int views = 0; // in the sum
    Texture sum;   // RGBA16F, 8 bytes a pixel: linear light
    Framebuffer framebuffer;

    void make(glm::ivec2 size);
};

class MeanPass {
public:
    [[nodiscard]] Result<void> make();
    void add(const ViewSetup& view, const LitTarget& from, MeanTarget& to) const;
    void show(const ViewSetup& view, const MeanTarget& from, const LitTarget& to) const;

private:
    Fullscreen add_, mean_;
};

class CastPass {
public:
    // Returns the number of cones. `records`: of the branches, made for this.
    std::uint64_t draw(const Subject& subject, const ViewSetup& view, BranchRecords& records);
    void send_picture(const PictureTarget& to) const;
    void send_depths(const PictureTarget& picture, const ResolvedTarget& to) const; // for what is drawn over it
    [[nodiscard]] const caster::Caster& caster() const { return caster_; }

private:
    caster::Caster caster_;
};

} // namespace ramus::render
