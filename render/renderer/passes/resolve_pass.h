// ResolvePass: reduces samples to one value per pixel, for picking, outlines and occlusion, and sorts the lists of
// glass. OcclusionPass: ambient occlusion per pixel.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/renderer/targets.h"

#include <string>

namespace ramus::render {

class ResolvePass {
public:
    [[nodiscard]] Result<void> make();
    [[nodiscard]] Result<void> make_capped(); // call before drawing a view with caps; builds the programs once
    // kOpaque: opaque surfaces. kGlass: also glass, from the lists or the first layers. kLesions: only the first layer
    // of lesions, over the existing result (before OpenGL 4.3).
    enum class What { kOpaque, kGlass, kLesions };
    void draw(What what, ViewTargets& targets, Band band) const;

private:
    struct Programs {
        Fullscreen opaque, glass, lesions;
        [[nodiscard]] Result<void> make(const std::string& defines);
    };
    Programs plain_, capped_;
};

// Also computes shadows if the frame has any.
class OcclusionPass {
public:
    [[nodiscard]] Result<void> make();
    // Reads the output of ResolvePass. Blurs along one axis and then the other, where `from` is covered.
    void draw(const Frame& frame, const ViewSetup& view, const ResolvedTarget& from, const OcclusionTarget& to) const;

private:
    Fullscreen taps_, with_shadows_, blur_;
};

// For a program with CAPS.
void set_caps(GLuint program, const ViewSetup& view);

// Binds the lists of glass for a program that writes or reads one band.
void bind_lists(GLuint program, const ViewTargets& targets, Band band);

} // namespace ramus::render
