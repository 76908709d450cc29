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
inline constexpr int kTilePixels = kTile * kTile;
inline constexpr int kSamples = 4;
inline constexpr int kMostPanes = 16; // of glass behind each other in one sample; nearer ones win
inline constexpr float kNothing = 1e30F;

// Where in its pixel a sample lies: those of the resting picture's rasteriser, so that edges stay where they are.
inline constexpr float kSampleX[kSamples] = {0.375F, 0.875F, 0.125F, 0.625F};
inline constexpr float kSampleY[kSamples] = {0.125F, 0.375F, 0.625F, 0.875F};

struct View {
    int width = 0, height = 0, stride = 0; // pixels; rows of the arrays below are `stride` apart
    float centre_x = 0, centre_y = 0;      // pixel that the eye looks through
    float mm_a_pixel = 0;                  // at depth 1 when perspective
    bool flat = false;                     // orthographic
    ViewBlock block{};                     // as the shaders have it
    int taps = 20;                         // of the occlusion, 0: none
};

// The hull of two balls. What cone.frag explains about the meeting of a ray with it holds here.
struct Cone {
    float from[3], axis[3]; // axis: to the other end
    float middle_depth;
    float first_radius, last_radius, growth;
    float squared, shrunk, inverse_shrunk; // |axis|^2, |axis|^2 - growth^2 and its inverse
    float from_way[4], to_way[4];          // the vessel's direction at both ends; 3: 1 where it goes on
    float pixel[2], way[2], length, reach; // in the picture: from where to where, and how far beside that, pixels
    float nearest;                         // depth
    float depth[3];   // of the axis: at its first end, and how it changes to the other; when [2] is 0, its inverse
    float widest;     // radius
    float value[2];   // at both ends, to colour by
    std::uint32_t id; // as in ids.glsl
    bool contested;   // some of what it is near is of another layer
    bool follows;     // its first ball is the last one of an opaque cone, neither is contested: that one meets it
};

// A triangle of a mesh beside the tree, counter-clockwise in the picture.
struct Triangle {
    struct Edge {
        float x, y, way_x, way_y; // from where in which way, pixels
        bool own;                 // what lies on it is this triangle's
    };
    Edge edge[3];              // across from each corner
    float share;               // 1 / twice its area
    float depth[3];            // times what a place spans with the edges: depth, or its inverse when perspective
    float normal[3][3];        // likewise, times `share`
    float slope[3];            // of the share that each corner has, per pixel
    float low[2], high[2];     // box, pixels
    float half_width, crowded; // of lines, pixels, and how faint they are where triangles crowd; 0: a surface
    std::uint32_t id;
};

// The triangles that touch each block of a tile: of block b, order[first[b]] to order[first[b + 1] - 1].
struct BlockTriangles {
    const Triangle* all;
    const std::uint32_t *first, *order;
};

// A segment of the convolution surface's field, in eye space, mm.
struct Piece {
    float from[3], way[3]; // way: of unit length
    float length, radius, slope;
};
inline constexpr Piece kNowhere{{1e9F, 1e9F, 1e9F}, {1.0F, 0.0F, 0.0F}, 1.0F, 1.0F, 0.0F};

// What the surface of each cone is made of: the pieces near[first[c]] to near[first[c + 1] - 1], an even number.
struct Field {
    const Piece* pieces; // null: the surface is the cones
    const std::uint32_t* first;
    const std::uint32_t* near;
    float root_width, isovalue; // of the kernel
    // Those of the near ones of a cone that are of another layer; an even number as well.
    const std::uint32_t *first_rival, *rivals;
    const std::uint32_t* branch; // of each piece
    const Layer* layer;          // of its branch
};

// Nearest hit of every sample of a tile. [block][sample][4 * row + column].
struct alignas(64) Samples {
    float depth[kBlocks * kBlocks][kSamples][16];
    std::uint32_t id[kBlocks * kBlocks][kSamples][16];
    std::uint32_t normal[kBlocks * kBlocks][kSamples][16]; // octahedral, y up and z towards the eye
    float value[kBlocks * kBlocks][kSamples][16];
    std::uint32_t cone[kBlocks * kBlocks][16]; // that the first sample hit
    float farthest[kBlocks * kBlocks];         // of the block's depths
    bool touched[kBlocks * kBlocks];           // else it holds nothing, and what is above means nothing
};

// What is shaded at once: one record for the pixels of one surface, one a sample on edges.
inline constexpr std::uint32_t kPixelMask = kTilePixels - 1, kSampleShift = 10, kWhole = 1U << 12;
struct Records {
    std::uint32_t* place; // pixel of the tile, sample << kSampleShift, kWhole
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
    // Depths once more, dealt into planes by column: every fourth of a row, `dealt_stride` a row, and `dealt_plane`
    // from plane to plane. There the taps of pixels that lie four apart lie side by side.
    float* dealt;
    std::ptrdiff_t dealt_stride, dealt_plane;
    float* occlusion; // before and
    float* smooth;    // after its noise is gone
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

} // namespace ramus::render::caster
