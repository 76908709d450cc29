// Render targets of one view, by the pass that fills them. Refinement has a second set for further views. Sizes are
// bytes per pixel; `s` is the number of samples.
#pragma once

#include "render/gl/bindings.h"
#include "render/gl/gl_objects.h"
#include "render/image/image.h"
#include "render/renderer/view_setup.h"

#include <array>
#include <glm/vec2.hpp>
#include <vector>

namespace ramus::render {

struct SampleTarget {  // SurfacePass, CenterlinePass, ContextPass: opaque surfaces, multisampled
    Texture id_normal; // RG32UI, 8 s bytes: id as in ids.glsl, octahedral normal
    Texture depth;     // DEPTH32F, 4 s bytes: reversed, 0: nothing
    Framebuffer framebuffer;
    // For surfaces with values, created on first use. Only vessels write here.
    Texture values; // R32F, 4 s bytes
    Framebuffer valued_framebuffer;
    // For caps of what is cut away, created on first use: how often a ray is inside, and the depth of back faces.
    Texture caps; // DEPTH32F_STENCIL8, 8 s bytes
    Framebuffer caps_framebuffer, valued_caps_framebuffer;
    std::array<glm::vec2, kMostSamples> positions{}; // sample positions relative to the pixel's middle
};

struct ResolvedTarget {   // ResolvePass: one value per pixel
    Texture id_normal;    // RG32UI, 8 bytes: id for picks; normal of the opaque surface
    Texture opaque_depth; // R32F, 4 bytes: mm along the line of sight, opaque surface
    Texture picked_depth; // R32F, 4 bytes: the same for picks
    Texture covered;      // DEPTH32F, 4 bytes: full-screen passes skip empty pixels with it
    Framebuffer framebuffer;
};

// The pick data of a view whose ResolvedTarget has been reused since.
struct KeptTarget {
    glm::ivec2 size{0};
    ResolvedTarget resolved; // without `covered`
};

struct OcclusionTarget {                // OcclusionPass, 6 bytes
    Texture raw, half_blurred, blurred; // RG8: sky; key light
    Framebuffer raw_target, half_target, blurred_target;
};

struct LitTarget {  // ShadePass and MeanPass
    Texture colour; // RGBA8, 4 bytes: sRGB, premultiplied
    Framebuffer framebuffer;
};

struct SlicedTarget { // ShadePass: `lit` with the planes of a scan; created on first use
    LitTarget lit;    // 4 bytes: the same, with the planes
    Texture depth; // R32F, 4 bytes: mm along the line of sight, nearest plane or opaque surface; only if lines need it
    Texture guide; // RG32F, 8 bytes: depth values of the nearest and the farthest sample, see slice_guide.glsl
    Texture mixed; // DEPTH32F, 4 bytes: not 0 where slices and surfaces meet
    Framebuffer framebuffer, colour_framebuffer, guide_framebuffer;
    bool guided = false; // `guide` belongs to what is shaded
};

struct Band { // rows, in GL's sense of y
    int first = 0, count = 0;
};

struct FragmentLists {       // FragmentListPass, from OpenGL 4.3 on; as in glass_fragments.glsl
    Buffer heads;            // 4 bytes per pixel of the largest band
    Buffer fragments;        // 16 bytes each, at most kGlassBytes
    Buffer count;            // 4 bytes
    Framebuffer framebuffer; // only the depth of the samples
    std::size_t head_capacity = 0, capacity = 0;
    std::vector<Band> bands; // of the last picture with glass; if one, its lists are still valid
};

struct GlassLayers {               // LayerPass, before OpenGL 4.3: created on first use
    Texture fragments;             // RG32UI, 8 s bytes: one layer of glass
    std::array<Texture, 2> depths; // DEPTH32F, 4 s bytes each: of this layer and of the previous one
    std::array<Framebuffer, 2> framebuffers;
    Texture fronts; // RGBA32F, 16 x kMostSamples bytes: glass in front of each sample
    Framebuffer fronts_framebuffer;
};

struct ViewTargets {
    ViewSetup view;         // the last view drawn into them, perhaps partly
    bool has_glass = false; // also for transparent context and lesions
    SampleTarget samples;
    ResolvedTarget resolved;
    OcclusionTarget occlusion;
    LitTarget lit;
    SlicedTarget sliced;
    bool has_planes = false; // the picture is in `sliced`, and `lit` is the view without planes
    FragmentLists lists;
    GlassLayers layers;

    [[nodiscard]] bool fit(glm::ivec2 size, int samples) const;
    // Allocates targets for `view.size` pixels. Throws OutOfGraphicsMemory.
    void make(int samples_a_pixel);
    void make_values(); // unless they exist
    void make_sliced(); // unless they exist
    void make_caps();   // unless they exist
    [[nodiscard]] const LitTarget& picture() const { return has_planes ? sliced.lit : lit; }
    // Of the nearest plane or opaque surface, mm.
    [[nodiscard]] GLuint seen_depth() const { return has_planes ? sliced.depth : resolved.opaque_depth; }
    // Swaps `resolved` with `kept`, so that picks in the last view stay possible. Throws OutOfGraphicsMemory.
    void keep_resolved(KeptTarget& kept);

private:
    glm::ivec2 made_for_{0};
};

// PictureTarget: a picture in a texture; copies it to memory or to another framebuffer.
struct PictureTarget {
    glm::ivec2 size{0};
    Texture colour; // RGBA8, 4 bytes per pixel: sRGB, premultiplied, rows from below
    Framebuffer framebuffer;

    void make(glm::ivec2 pixels); // `size` is 0 if this throws
    void bind() const;
    void put(const Image& opaque); // of this size
    // Straight alpha, rows from the top; an empty image if the size is 0.
    [[nodiscard]] Image read() const;
    [[nodiscard]] Image read_premultiplied() const;
    // Copies the picture into framebuffer `to` (0: the window's), its lower left corner at (x, y). If its size is not
    // `filled`, scales it to the height of `filled`, centres it and crops it. Leaves `to` bound for drawing.
    void present(GLuint to, int x, int y, glm::ivec2 filled) const;
    // Inverse of present(): the picture's pixel, from the top left, that is shown at `at`.
    [[nodiscard]] static glm::dvec2 pixel_presented(glm::ivec2 size, glm::ivec2 filled, glm::dvec2 at);
};

} // namespace ramus::render
