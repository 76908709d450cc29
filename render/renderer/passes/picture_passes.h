// CopyPass copies the lit image to the picture, and enlarges it if it has fewer pixels. MeanPass averages several
// views.
#pragma once

#include "render/renderer/passes/shade_pass.h"
#include "render/renderer/targets.h"

namespace ramus::render {

class CopyPass {
public:
    [[nodiscard]] Result<void> make() { return enlarge_.make("enlarge.frag"); }
    // Copies only `region`, which was shaded: the rest has its overlays already. Enlarged pictures are copied
    // completely.
    void draw(const ViewSetup& view, const LitTarget& from, const PictureTarget& to, const Region& region) const;

private:
    Fullscreen enlarge_;
};

struct MeanTarget {
    int views = 0; // number of views in the sum
    Texture sum;   // RGBA16F, 8 bytes per pixel: linear light
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
