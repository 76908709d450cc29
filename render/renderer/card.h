// Card: everything that a Renderer keeps on the graphics card, by owner. Headers of objects with the picture's size
// give their bytes per pixel; `s` is the number of samples, 4 at rest.
// clang-format off
// | owner                  | what                                         | bytes
// | Passes                 | about twenty programs, and shade_pass.h      | the driver's
// | SceneOnCard (surfaces) | pages of mesh and preview                    | GpuMesh::bytes(), surface_bytes
// | SceneOnCard (near)     | divided triangles that replace some pages    | at most 120 MB, in addition
// | SceneOnCard (the rest) | centerlines, skeleton, context and lesions   | 24 per point and vertex, 12 per triangle
// | ShadePass              | branches, cuts, lesions, ramp, distances     | 8 per branch; 4 per sample of the grid
// | ViewTargets            | samples, resolved, occlusion, lit: targets.h | 12 s + 30 per pixel
// | SampleTarget.caps      | of what is cut away                          | 8 s per pixel
// | ViewTargets.sliced     | the same with planes of a scan                | 20 per pixel
// | PlaneTables            | pictures of the planes                       | 4 per pixel of the largest, each
// | ViewTargets.lists      | glass from OpenGL 4.3 on                     | 4 per pixel, 16 per fragment: kGlassBytes
// | ViewTargets.layers     | glass before that                            | 16 s + 64 per pixel
// | PictureTarget          | the picture                                  | 4 per pixel; window 8 more, ShownPicture
// | Refinement             | another ViewTargets, and MeanTarget          | 8 per pixel for MeanTarget
// | PickRequest            | what a pick reads back                       | some KB
// clang-format on
//
// Any allocation may run out of memory; release() then releases the picture and everything that was sent for it.
#pragma once

#include "render/renderer/passes/cast_pass.h"
#include "render/renderer/passes/overlay_passes.h"
#include "render/renderer/passes/picture_passes.h"

namespace ramus::render {

// The passes, in the order in which they draw.
struct Passes {
    explicit Passes(std::size_t glass_bytes)
        : lists(context, resolve, glass_bytes), layers(context, resolve), shade(lists, layers) {}
    // Builds the programs unless they exist. The caster's pictures need few programs, and a window's first picture is
    // one.
    enum class For { kCast, kAll };
    [[nodiscard]] Result<void> make(For what);

    // Sets up the state for the passes of a view, whatever state OpenGL is in.
    void begin(const ViewSetup& view) const;
    // Closes what a cut has opened. Returns the number of triangles.
    [[nodiscard]] InParts<std::uint64_t> draw_caps(const Subject& subject, ViewTargets& targets);
    [[nodiscard]] InParts<Result<std::uint64_t>> draw_glass(const Subject& subject, ViewTargets& targets);
    // Draws a view up to its occlusion. `moving`: cones may replace the surface. Returns the number of triangles.
    [[nodiscard]] InParts<Result<std::uint64_t>> draw_view(Subject subject, ViewTargets& targets, bool moving);
    // Draws the overlays within `region`. `ids`: texture with the id at each pixel.
    void draw_overlays(const Subject& subject, const ViewTargets& targets, const PictureTarget& to,
                       const Region& region, GLuint ids);

    CastPass cast; // replaces all passes up to the shading
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
    void release(); // after running out of memory: releases everything but programs

    Passes passes;
    SceneOnCard scene;
    ViewTargets targets;
    PictureTarget picture;
};

} // namespace ramus::render
