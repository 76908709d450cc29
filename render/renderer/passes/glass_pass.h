// Glass, exactly. FragmentListPass: every pixel has a list of all glass fragments that cover it, whatever order the
// triangles come in. The lists have a bound in bytes; a picture that would need more is made band by band, each of
// which fits: slower, never wrong.
//
// LayerPass: the same where shaders cannot write lists (before OpenGL 4.3), layer by layer. Each pass draws the glass
// again and keeps, in every pixel, the nearest fragment behind the one before (depth peeling: C. Everitt, Interactive
// Order-Independent Transparency, 2001); that one goes onto those before it, sample by sample, as a list's next
// fragment would. Where it differs: of fragments with the very same depth at a sample one is seen; and what lies behind
// kMostLayers fragments of one pixel is not. A layer of glass is one to four of them where edges cross the pixel.
// Branches beyond 8 million have no number here.
#pragma once

#include "render/renderer/passes/resolve_pass.h"
#include "render/renderer/passes/surface_passes.h"

namespace ramus::render {

// What both draw and sort with, which outlives them.
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
    // The lists take `most_bytes` at most.
    FragmentListPass(const ContextPass& context, const ResolvePass& resolve, std::size_t most_bytes)
        : GlassPass(context, resolve), most_bytes_(most_bytes) {}

    // Lists and sorts all fragments, in one band if there is room, and resolves. Returns the number of triangles.
    [[nodiscard]] InParts<Result<std::uint64_t>> draw(const Subject& subject, ViewTargets& targets) const;
    // The same of one of several bands, whose lists have given way to those of others.
    void draw_again(const Subject& subject, ViewTargets& targets, Band band) const;

private:
    struct Listed {
        std::size_t fragments = 0; // more than there is room for: not all are there
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

    // The vessels' nearest layer alone, for what is picked and outlined, where context and lesions are, and the
    // lesions' nearest layer alone, which is picked through no glass; resolves. Returns the number of triangles.
    [[nodiscard]] std::uint64_t draw_first(const Subject& subject, ViewTargets& targets) const;
    // All layers into the fronts of `targets`, front to back. `light` is a variant of shade.frag, whose blocks and
    // tables are bound.
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
