// What one view is drawn into, by the pass that fills it. A picture that is refined has a second set for further views.
// Bytes are a pixel's; `s` is the number of samples.
#pragma once

#include "render/gl/bindings.h"
#include "render/gl/gl_objects.h"
#include "render/image/image.h"
#include "render/renderer/view_setup.h"

#include <array>
#include <glm/vec2.hpp>
#include <vector>

namespace ramus::render {

struct SampleTarget {  // SurfacePass, CenterlinePass, ContextPass: what is opaque, multisampled
    Texture id_normal; // RG32UI, 8 s bytes: id as in ids.glsl, octahedral normal
    Texture depth;     // DEPTH32F, 4 s bytes: reversed, 0 is nothing
    Framebuffer framebuffer;
    // Of surfaces that have values, made when they are needed; what is drawn beside vessels does not write here.
    Texture values; // R32F, 4 s bytes
    Framebuffer valued_framebuffer;
    std::array<glm::vec2, kMostSamples> positions{}; // of samples, from the pixel's middle
};

struct ResolvedTarget {   // ResolvePass: one value a pixel
    Texture id_normal;    // RG32UI, 8 bytes: what is pointed at; the opaque surface's normal
    Texture opaque_depth; // R32F, 4 bytes: mm along the line of sight, of what is opaque
    Texture picked_depth; // R32F, 4 bytes: of what is pointed at
    Texture covered;      // DEPTH32F, 4 bytes: full-screen passes skip what is empty by testing against it
    Framebuffer framebuffer;
};

// What is pointed at in a view that was drawn into a ResolvedTarget, which another one is drawn into since.
struct KeptTarget {
    glm::ivec2 size{0};
    ResolvedTarget resolved; // without `covered`
};

struct OcclusionTarget {                // OcclusionPass, 6 bytes
    Texture raw, half_blurred, blurred; // RG8: of the sky; of the key light
    Framebuffer raw_target, half_target, blurred_target;
};

struct LitTarget {  // ShadePass and MeanPass
    Texture colour; // RGBA8, 4 bytes: sRGB, premultiplied
    Framebuffer framebuffer;
};

struct Band { // rows, in GL's sense of y
    int first = 0, count = 0;
};

struct FragmentLists {       // FragmentListPass, from OpenGL 4.3 on; as in glass_fragments.glsl
    Buffer heads;            // 4 bytes a pixel of the largest band
    Buffer fragments;        // 16 bytes each, kGlassBytes at most
    Buffer count;            // 4 bytes
    Framebuffer framebuffer; // the samples' depth alone
    std::size_t head_capacity = 0, capacity = 0;
    std::vector<Band> bands; // of the last picture with glass: one, and its lists are still there, or several
};

struct GlassLayers {               // LayerPass, before OpenGL 4.3: made when they are needed
    Texture fragments;             // RG32UI, 8 s bytes: one layer of glass
    std::array<Texture, 2> depths; // DEPTH32F, 4 s bytes each: its depth, and that of the layer before
    std::array<Framebuffer, 2> framebuffers;
    Texture fronts; // RGBA32F, 16 x kMostSamples bytes: of each sample, all glass before it
    Framebuffer fronts_framebuffer;
};

struct ViewTargets {
    ViewSetup view;         // the last one that was drawn, or is being drawn, into them
    bool has_glass = false; // or context that is clear, or lesions: of that view
    SampleTarget samples;
    ResolvedTarget resolved;
    OcclusionTarget occlusion;
    LitTarget lit;
    FragmentLists lists;
    GlassLayers layers;

    [[nodiscard]] bool fit(glm::ivec2 size, int samples) const;
    // Makes them for views of so many pixels, `view.size`, and samples. Throws OutOfGraphicsMemory.
    void make(int samples_a_pixel);
    void make_values(); // unless they are there
    // Keeps what was resolved; the next view is drawn into what was kept before. Throws OutOfGraphicsMemory.
    void keep_resolved(KeptTarget& kept);

private:
    glm::ivec2 made_for_{0};
};

// PictureTarget: a picture in a texture, and the way from there to memory or to another framebuffer.
struct PictureTarget {
    glm::ivec2 size{0};
    Texture colour; // RGBA8, 4 bytes a pixel: sRGB, premultiplied, rows from below
    Framebuffer framebuffer;

    void make(glm::ivec2 pixels); // of no size until it is there
    void bind() const;
    // Straight alpha, rows from above. Of no size: an empty image.
    [[nodiscard]] Image read() const;
    [[nodiscard]] Image read_premultiplied() const;
    // Copies the picture into framebuffer `to` (0 = the window's), its lower left corner at (x, y). One of another size
    // than `filled` is scaled to be as high, its middle in the middle, and cut off beyond. Leaves `to` bound for
    // drawing.
    void present(GLuint to, int x, int y, glm::ivec2 filled) const;
    // The pixel of a picture of this size, from the top left, that present() puts there.
    [[nodiscard]] static glm::dvec2 pixel_presented(glm::ivec2 size, glm::ivec2 filled, glm::dvec2 at);
};

} // namespace ramus::render
