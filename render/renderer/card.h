// Card: all that a Renderer has on the graphics card, by owner. What is of one picture's size names its bytes a pixel
// in its own header; `s` is the number of samples, 4 at rest.
//
// clang-format off
// | owner                  | what                                         | bytes
// | Passes                 | programs: some twenty, and shade_pass.h      | the driver's
// | SceneOnCard (surfaces) | pages of mesh and preview                    | GpuMesh::bytes(), surface_bytes
// | SceneOnCard (near)     | what stands for some of those pages          | 120 MB at most, beside
// | SceneOnCard (the rest) | centerlines, skeleton, context and lesions   | 24 a point and vertex, 12 a triangle
// | ShadePass              | branches, cuts, lesions, ramp, distances     | 8 a branch; 4 a grid's sample
// | ViewTargets            | samples, resolved, occlusion, lit: targets.h | 12 s + 30 a pixel
// | ViewTargets.lists      | glass from OpenGL 4.3 on                     | 4 a pixel, 16 a fragment: kGlassBytes
// | ViewTargets.layers     | glass before that                            | 16 s + 64 a pixel
// | PictureTarget          | the picture                                  | 4 a pixel; the window's 8 more, ShownPicture
// | Refinement             | ViewTargets once more, and MeanTarget        | 8 a pixel beside
// | PickRequest            | what a pick reads back                       | some KB
// clang-format on
//
// Memory may run out in any allocation: let_go() then leaves nothing of the picture and of what was sent for it.
#pragma once

#include "render/renderer/passes/cast_pass.h"
#include "render/renderer/passes/overlay_passes.h"
#include "render/renderer/passes/picture_passes.h"

namespace ramus::render {

// The passes, in the order in which they draw.
struct Passes {
    explicit Passes(std::size_t glass_bytes)
        : lists(context, resolve, glass_bytes), layers(context, resolve), shade(lists, layers) {}
    // Makes their programs, unless they are there. The caster's pictures need few, and a window's first is one.
    enum class For { kCast, kAll };
    [[nodiscard]] Result<void> make(For what);

    // Before passes of a view, whatever others have left.
    void begin(const ViewSetup& view) const;
    // A view up to its occlusion. `moving`: cones may stand for the surface. Returns the number of triangles.
    [[nodiscard]] InParts<Result<std::uint64_t>> draw_view(Subject subject, ViewTargets& targets, bool moving) const;
    // What lies over the picture, as far as `region` shows what is new. `ids`: of who is at its pixels.
    void draw_overlays(const Subject& subject, const ViewTargets& targets, const PictureTarget& to,
                       const Region& region, GLuint ids);

    CastPass cast; // in place of all up to the shading
    SurfacePass surface;
    CenterlinePass centerlines;
    ContextPass context;
    ResolvePass resolve;
    FragmentListPass lists; // one of these two, by the version of OpenGL
    LayerPass layers;
    OcclusionPass occlusion;
    ShadePass shade;
    MeanPass mean;
    CopyPass copy;
    SkeletonPass skeleton;
    MarkPass marks;
    SpritePass sprites;

private:
    void send(const ViewSetup& view) const;
    Buffer view_block_;
    bool made_for_cast_ = false, made_ = false;
};

struct Card {
    Card(std::size_t glass_bytes, std::size_t surface_bytes) : passes(glass_bytes), scene(surface_bytes) {}
    void let_go(); // after memory has run out: of all but programs

    Passes passes;
    SceneOnCard scene;
    ViewTargets targets;
    PictureTarget picture;
};

} // namespace ramus::render
