// ResolvePass: one value a pixel from the samples, for picking, outlines and the occlusion; the lists of glass are put
// in order on the way. OcclusionPass: how much of the sky each pixel's surroundings take.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/renderer/targets.h"

namespace ramus::render {

class ResolvePass {
public:
    [[nodiscard]] Result<void> make();
    // Of opaque surfaces; with glass, which the lists or the first layers have; or of lesions alone, whose first layer
    // goes over what was there (before OpenGL 4.3).
    enum class What { kOpaque, kGlass, kLesions };
    void draw(What what, ViewTargets& targets, Band band) const;

private:
    Fullscreen opaque_, glass_, lesions_;
};

// And shadows, where the frame has any.
class OcclusionPass {
public:
    [[nodiscard]] Result<void> make();
    // From what ResolvePass left. Blurred where `from` is covered, along one axis and then the other.
    void draw(const Frame& frame, const ViewSetup& view, const ResolvedTarget& from, const OcclusionTarget& to) const;

private:
    Fullscreen taps_, with_shadows_, blur_;
};

// The lists of glass, for a program that is to draw or to read a band's.
void bind_lists(GLuint program, const ViewTargets& targets, Band band);

} // namespace ramus::render
