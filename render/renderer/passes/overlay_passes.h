// What lies over the picture, in its own pixels: SkeletonPass draws centerlines and rings of the radius, MarkPass
// lines, SpritePass small pictures. All blend over what is there.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/overlay/overlay.h"
#include "render/renderer/passes/shade_pass.h"

#include <optional>

namespace ramus::render {

class SkeletonPass {
public:
    // Its programs are made when there is a skeleton first. `opaque_depth` is that of ResolvedTarget.
    void draw(const Subject& subject, const ViewSetup& view, GLuint opaque_depth);

private:
    bool make();
    void use(const Program& program, const Subject& subject, const ViewSetup& view) const;
    void draw_rings(const Subject& subject) const;

    Program lines_, rings_;
    VertexArray no_vertices_;
};

class MarkPass {
public:
    [[nodiscard]] Result<void> make();
    // Laid out in pixels, joined without gaps or overlaps, drawn with soft edges.
    // `ids`: of who is at each pixel; `branches`: the table of their records (scene_tables.h), of the last picture that
    // was shaded.
    void draw(const Subject& subject, const ViewTargets& targets, GLuint ids, GLuint branches) const;

private:
    Program program_;
};

// `image` (straight alpha) with its lower left corner at `at`, as far as it lies in `region`. `program`: overlay.frag.
void draw_sprite(const Fullscreen& program, const Image& image, glm::ivec2 at, const Region& region);

class SpritePass {
public:
    [[nodiscard]] Result<void> make() { return program_.make("overlay.frag"); }
    // As far as they lie in `region`.
    void draw(const Frame& frame, const Region& region);

private:
    Fullscreen program_;
    OverlayPainter painter_;
    std::vector<Sprite> sprites_; // painted once: that takes longer than shading
    std::optional<SpriteSource> painted_of_;
};

} // namespace ramus::render
