// Draws glass with exact order-independent transparency.
//
// FragmentListPass (OpenGL 4.3 on): every pixel has a list of all glass fragments that cover it, in any order of
// triangles. The lists have a limit in bytes; larger pictures are drawn in bands that fit, slower but with the same
// result.
//
// LayerPass (before 4.3): depth peeling (C. Everitt, Interactive Order-Independent Transparency, 2001). Each pass draws
// the glass again, keeps the nearest fragment behind the previous one in every pixel, and composes it, sample by
// sample, as it would the next fragment of a list. Differences: of several fragments at exactly the same depth of a
// sample only one is seen, fragments behind the first kMostLayers of a pixel are lost, and branches beyond 8 million
// have no number. A surface layer takes one to four fragments where edges cross the pixel.
#pragma once

#include "render/renderer/passes/resolve_pass.h"
#include "render/renderer/passes/surface_passes.h"

namespace ramus::render {

// What both passes share. The constructor's arguments must outlive the pass.
class GlassPass {
public:
    GlassPass(const ContextPass& context, const ResolvePass& resolve) : context_(context), resolve_(resolve) {}
    [[nodiscard]] Result<void> make();

protected:
    const ContextPass& context_;
    const ResolvePass& resolve_;
    Program vessels_, borders_;
};

class FragmentListPass : public GlassPass {
public:
    // `most_bytes`: limit of the lists.
    FragmentListPass(const ContextPass& context, const ResolvePass& resolve, std::size_t most_bytes)
        : GlassPass(context, resolve), most_bytes_(most_bytes) {}

    // Collects and sorts all fragments, in one band if possible, and resolves. Returns the number of triangles.
    [[nodiscard]] InParts<Result<std::uint64_t>> draw(const Subject& subject, ViewTargets& targets) const;
    // Repeats this for one of several bands, whose lists were overwritten by those of other bands.
    void draw_again(const Subject& subject, ViewTargets& targets, Band band) const;

private:
    struct Listed {
        std::size_t fragments = 0; // if this exceeds the capacity, some are missing
        std::uint64_t triangles = 0;
    };
    [[nodiscard]] InParts<Listed> list(const Subject& subject, ViewTargets& targets, Band band) const;
    bool grow(FragmentLists& lists, std::size_t wanted) const;

    std::size_t most_bytes_;
};

class LayerPass : public GlassPass {
public:
    using GlassPass::GlassPass;
    [[nodiscard]] Result<void> make();

    // Draws and resolves nearest layers for picking and outlines: of the vessels, of all transparent shapes, and of the
    // lesions, each without the others. Returns the number of triangles.
    [[nodiscard]] std::uint64_t draw_first(const Subject& subject, ViewTargets& targets) const;
    // Composes all layers front to back into `targets.layers.fronts`. `light`: a variant of shade.frag, with its blocks
    // and tables bound.
    void draw_all(const Subject& subject, ViewTargets& targets, const Fullscreen& light) const;

private:
    enum class Of { kVessels, kEverything };
    bool draw_layer(const Subject& subject, const ViewTargets& targets, int layer, Of what,
                    std::uint64_t& triangles) const;
    [[nodiscard]] std::uint64_t draw_clear(const Subject& subject, const ViewTargets& targets, ContextPass::Clear what,
                                           int layer) const;
    [[nodiscard]] std::uint64_t draw_first_clear(const Subject& subject, const ViewTargets& targets,
                                                 ContextPass::Clear what, std::size_t target) const;

    Query any_left_;
};

} // namespace ramus::render
