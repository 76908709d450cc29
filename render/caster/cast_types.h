// What the caster's stages hand to each other: the view, round cones in eye space, samples of a tile, records to shade.
// Plain arrays: the stages are compiled once per instruction set, and must not share inline code of containers.
//
// Eye space has depth as +z, mm. Pixels count from the lower left, as OpenGL's do.
#pragma once

#include "render/scene/layer.h"
#include "render/scene/uniform_blocks.h"

#include <cstddef>
#include <cstdint>

namespace ramus::render::caster {

inline constexpr int kTile = 32;               // pixels a side; what one task casts
inline constexpr int kOccludedTiles = 2;       // beside each other, occluded together
inline constexpr int kBlock = 4;               // pixels a side; what one vector of rays covers
inline constexpr int kBlocks = kTile / kBlock; // a side
inline constexpr int kBlockPixels = kBlock * kBlock;
inline constexpr int kTilePixels = kTile * kTile;
inline constexpr int kSamples = 4;
inline constexpr int kMaxFragments = 16; // of glass behind each other in one sample; nearer ones win
inline constexpr float kNothing = 1e30F; // depth where there is no surface

// Where in its pixel a sample lies: those of the resting picture's rasteriser, so that edges stay where they are.
inline constexpr float kSampleX[kSamples] = {0.375F, 0.875F, 0.125F, 0.625F};
inline constexpr float kSampleY[kSamples] = {0.125F, 0.375F, 0.625F, 0.875F};

// In between the first two, and the last two.
inline constexpr float kPairX[kSamples / 2] = {0.625F, 0.375F};
inline constexpr float kPairY[kSamples / 2] = {0.25F, 0.75F};

struct View {
    int width = 0, height = 0, stride = 0; // pixels; rows of the arrays below are `stride` apart
    float centre_x = 0, centre_y = 0;      // pixel that the eye looks through
    float mm_a_pixel = 0;                  // at depth 1 when perspective
    bool flat = false;                     // orthographic
    ViewBlock block{};                     // as the shaders have it
    int taps = 20;                         // of the occlusion, 0: none
    bool shadows = false;
};

// The hull of two balls in eye space. What cone.frag explains about the intersection of a ray with it holds here.
struct RoundCone {
    float from[3], axis[3]; // axis: to the other ball's centre
    float middle_depth;
    float first_radius, last_radius, radius_change;
    float axis_squared;                       // |axis|^2
    float side_squared, inverse_side_squared; // |axis|^2 - radius_change^2, of the side from ball to ball
    float from_direction[4], to_direction[4]; // of the vessel at both ends; [3]: 1 where it goes on there
    float image_from[2], image_direction[2];  // of the axis in the picture, pixels
    float image_length, image_half_width;     // pixels; the outline lies within half_width of the axis
    float nearest_depth;
    float depth[3]; // of the axis: at its first end, and how it changes to the other; when [2] is 0, its inverse
    float larger_radius;
    float value[2];         // at both ends, to colour by
    std::uint32_t id;       // as in ids.glsl
    bool near_other_layer;  // some of its neighbours are of another layer
    bool shares_first_ball; // with the opaque cone before it, neither is near another layer: that one is hit there
};

// A triangle of a mesh beside the tree, counter-clockwise in the picture.
struct Triangle {
    struct Edge {
        float x, y, direction_x, direction_y; // from where in which direction, pixels
        bool own;                             // what lies on it is this triangle's
    };
    Edge edge[3];              // across from each corner
    float share;               // 1 / twice its area
    float depth[3];            // times the edge functions of a point: its depth, or its inverse when perspective
    float normal[3][3];        // likewise, times `share`
    float slope[3];            // of the share that each corner has, per pixel
    float low[2], high[2];     // box, pixels
    float half_width, crowded; // of lines, pixels, and how faint they are where triangles crowd; 0: a surface
    std::uint32_t id;
};

// The round cones that may be seen in a tile, nearest first, for speed alone.
struct TileCones {
    const RoundCone* all;
    const std::uint32_t* order;
    std::size_t count;
};

// What may be seen in each block of a tile: in block b those numbered from *first[b] to before *first[b + 1].
template <class Thing> struct InBlocks {
    const Thing* all;
    const std::uint32_t* first[kBlocks * kBlocks + 1];
};
using BlockTriangles = InBlocks<Triangle>;
using BlockCones = InBlocks<RoundCone>; // nearest first

// A segment of the convolution surface's field, in eye space, mm.
struct FieldSegment {
    float from[3], direction[3]; // direction: of unit length
    float length, radius, slope, beyond;
};
inline constexpr FieldSegment kNoSegment{{1e9F, 1e9F, 1e9F}, {1.0F, 0.0F, 0.0F}, 1.0F, 1.0F, 0.0F, 0.0F};

// The field around each cone: of segments neighbours[first[c]] to neighbours[first[c + 1] - 1], an even number.
struct Field {
    const FieldSegment* segments; // null: the surface is the cones
    const std::uint32_t* first;
    const std::uint32_t* neighbours;
    float root_width, isovalue; // of the kernel
    // Those neighbours of a cone that are of another layer; an even number as well.
    const std::uint32_t *first_other, *other_layer;
    const std::uint32_t* branch; // of each segment
    const Layer* layer;          // of its branch
};

// A tile to cast, with what every stage needs.
struct TileTask {
    const View& view;
    const Field& field;
    bool with_values; // surfaces are coloured by a value along the vessels
    int x, y;         // lower left pixel
};

inline constexpr std::uint32_t kNoCone = ~0U;

// Nearest hit of every sample of a tile. [block][sample][4 * row + column].
struct alignas(64) Samples {
    float depth[kBlocks * kBlocks][kSamples][kBlockPixels];
    std::uint32_t id[kBlocks * kBlocks][kSamples][kBlockPixels];
    std::uint32_t normal[kBlocks * kBlocks][kSamples][kBlockPixels]; // octahedral, y up and z towards the eye
    float value[kBlocks * kBlocks][kSamples][kBlockPixels];
    std::uint32_t cone[kBlocks * kBlocks][kBlockPixels]; // that the first sample hit; kNoCone: a triangle
    float farthest[kBlocks * kBlocks];                   // of the block's depths
    bool touched[kBlocks * kBlocks];                     // else it holds nothing, and what is above means nothing
};

// What is shaded at once: one record for the pixels of one surface, one a sample on edges.
inline constexpr std::uint32_t kPixelMask = kTilePixels - 1, kSampleShift = 10, kWhole = 1U << 12,
                               kPair = 1U << 13; // of the sample and the next one
struct Records {
    std::uint32_t* position; // pixel of the tile, sample << kSampleShift; kWhole: of all samples, kPair: of two
    std::uint32_t* id;
    std::uint32_t* normal;
    float* depth;
    float* value; // null: none
    std::size_t count;
};

// Of the whole picture, `stride` a row.
struct PictureArrays {
    float* depth;          // nearest opaque surface; kNothing: none
    float* picked_depth;   // nearest of anything
    std::uint32_t* id;     // of that, 0: nothing
    std::uint32_t* normal; // of the nearest opaque surface
    // Depths once more, in four planes by column: every fourth of a row, `plane_stride` a row, and `plane_size` from
    // plane to plane. There the taps of pixels that lie four apart lie side by side.
    float* depth_planes;
    std::ptrdiff_t plane_stride, plane_size;
    struct Taken {     // of what light there is
        float* rough;  // before and
        float* smooth; // after its noise is removed
    };
    Taken sky, key; // by the occlusion, and by shadows
};

// All uniform blocks of shade.frag.
struct Uniforms : ViewBlock, LookBlock, SceneBlock {};

// Distances to lesions that are meshes, mm, x fastest.
struct LesionGrid {
    const float* values;
    int size[3];
    vec4 from_eye[3]; // eye space to samples of the grid: rows of a matrix
};

// What the formulas of shaders/look read: uniforms, and arrays where the shaders have textures.
struct Shading {
    Uniforms uniforms;
    int width, height, stride;     // pixels
    const std::uint32_t* branches; // two words each: red, green; blue, flags
    bool outlined;
    vec2 outline_ring[12], halo_ring[12]; // steps from a pixel to those around it
    const float* ramp;                    // rgb, sRGB
    int ramp_steps;
    const vec4* lesions; // spheres: centre in eye space, radius
    LesionGrid grid;
    const float* context; // linear colour and opacity of every context mesh; negative opacity: lines
    const vec4* cuts;     // five a part of a branch that is lost, see behind_cut()
};

// A vessel's cross section: the circle that is nearest to the surface there.
struct CrossSection {
    float middle[3], side[3], up[3]; // side, up: unit vectors in its plane; in the space of the field's segments
    float radius;                    // of the vessel, then of the circle
    float least, most;               // that the radius may be, in radii of the vessel
    std::uint32_t segment;           // there, whose neighbours make the surface
};

} // namespace ramus::render::caster
