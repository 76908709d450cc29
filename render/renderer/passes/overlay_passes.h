// Passes that draw over the picture, at its full resolution: SkeletonPass draws centerlines and rings of the radius,
// MarkPass lines, SpritePass small pictures. All blend with the picture.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/overlay/overlay.h"
#include "render/renderer/passes/shade_pass.h"

#include <optional>

namespace ramus::render {

class SkeletonPass {
public:
    // Builds its programs on first use. `opaque_depth`: of ResolvedTarget.
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
    // Lines have widths in pixels, joints without gaps or overlaps, and soft edges. `ids`: texture with the id at each
    // pixel. `branches`: table of the branches' records (scene_tables.h) of the picture shaded last.
    void draw(const Subject& subject, const ViewTargets& targets, GLuint ids, GLuint branches) const;

private:
    Program program_;
};

// Draws `image` (straight alpha) with its lower left corner at `at`, clipped to `region`. `program`: overlay.frag.
void draw_sprite(const Fullscreen& program, const Image& image, glm::ivec2 at, const Region& region);

class SpritePass {
public:
    [[nodiscard]] Result<void> make() { return program_.make("overlay.frag"); }
    // Draws the frame's sprites, clipped to `region`.
    void draw(const Frame& frame, const Region& region);

private:
    Fullscreen program_;
    OverlayPainter painter_;
    std::vector<Sprite> sprites_; // cached: painting takes longer than shading
    std::optional<SpriteSource> painted_of_;
};

} // namespace ramus::render
