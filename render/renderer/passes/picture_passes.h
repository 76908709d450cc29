// From what was lit to the picture: CopyPass brings it there, MeanPass makes it the mean of several views.
#pragma once

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

} // namespace ramus::render
