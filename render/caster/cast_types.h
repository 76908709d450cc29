// Data that the stages of the caster exchange: the view, round cones in eye space, samples of a tile, records to shade.
// These are plain arrays, because the stages are compiled once per instruction set and must not share inline code of
// containers.
//
// Eye space: mm, +z is depth. Pixels count from the lower left, as in OpenGL.
#pragma once

#include "render/scene/layer.h"
#include "render/scene/uniform_blocks.h"

#include <cstddef>
#include <cstdint>

namespace ramus::render::caster {

inline constexpr int kTile = 32;               // pixels a side; what one task casts
inline constexpr int kOccludedTiles = 2;       // adjacent tiles that one task occludes together
inline constexpr int kBlock = 4;               // pixels a side; what one vector of rays covers
inline constexpr int kBlocks = kTile / kBlock; // a side
inline constexpr int kBlockPixels = kBlock * kBlock;
inline constexpr int kTilePixels = kTile * kTile;
inline constexpr int kSamples = 4;
inline constexpr int kMaxFragments = 16; // glass fragments kept per sample; the nearest are kept
inline constexpr float kNothing = 1e30F; // depth where there is no surface

// Position of each sample in its pixel. They equal those of the rasteriser that draws the picture at rest, so that
// edges do not move when the view stops.
inline constexpr float kSampleX[kSamples] = {0.375F, 0.875F, 0.125F, 0.625F};
inline constexpr float kSampleY[kSamples] = {0.125F, 0.375F, 0.625F, 0.875F};

// Midpoints of the first two samples and of the last two.
inline constexpr float kPairX[kSamples / 2] = {0.625F, 0.375F};
inline constexpr float kPairY[kSamples / 2] = {0.25F, 0.75F};

struct View {
    int width = 0, height = 0, stride = 0; // pixels; `stride`: distance of rows in the picture's arrays
    float centre_x = 0, centre_y = 0;      // the pixel on the view axis
    float mm_a_pixel = 0;                  // size of a pixel; in perspective at depth 1
    bool flat = false;                     // orthographic
    ViewBlock block{};                     // the uniform block that the shaders get
    int taps = 20;                         // samples of ambient occlusion per pixel; 0: no occlusion
    bool shadows = false;
};

// Convex hull of two balls in eye space, mm. cone.frag explains the intersection of a ray with it.
struct RoundCone {
    float from[3], axis[3]; // centre of the first ball; vector to the other centre
    float middle_depth;
    float first_radius, last_radius, radius_change;
    float axis_squared;                       // |axis|^2
    float side_squared, inverse_side_squared; // |axis|^2 - radius_change^2, for the side between the balls
    float from_direction[4], to_direction[4]; // the vessel's direction at both ends; [3]: 1 if it continues
    float image_from[2], image_direction[2];  // the axis in the picture, pixels
    float image_length, image_half_width;     // pixels; the outline stays within half_width of the axis
    float nearest_depth;
    float depth[3]; // of the axis: at its first end, and its change to the other end; inverse depths when [2] is 0
    float larger_radius;
    float value[2];         // for colouring, at both ends
    std::uint32_t id;       // as in ids.glsl
    bool near_other_layer;  // some of its neighbours belong to another layer
    bool shares_first_ball; // with the preceding opaque cone, which is hit there; neither is near another layer
};

// A projected triangle, counter-clockwise in the picture.
struct Triangle {
    struct Edge {
        float x, y, direction_x, direction_y; // origin and direction, pixels
        bool own;                             // samples exactly on this edge belong to this triangle
    };
    Edge edge[3];          // edge[i] is opposite to corner i
    float share;           // 1 / twice its area
    float depth[3];        // coefficients of the edge functions; they sum to the depth, in perspective to its inverse
    float normal[3][3];    // coefficients of the edge functions for the normal, to be multiplied by `share`
    float slope[3];        // change of each corner's barycentric coordinate per pixel
    float low[2], high[2]; // box, pixels
    float half_width, crowded; // for lines along edges: pixels (0: a surface), and opacity where triangles crowd
    std::uint32_t id;
};

// The round cones that may be visible in a tile, nearest first. The order affects only speed.
struct TileCones {
    const RoundCone* all;
    const std::uint32_t* order;
    std::size_t count;
};

// What may be visible in each block of a tile: block b has the indices from *first[b] up to but excluding *first[b +
// 1].
template <class Thing> struct InBlocks {
    const Thing* all;
    const std::uint32_t* first[kBlocks * kBlocks + 1];
};
using BlockTriangles = InBlocks<Triangle>;
using BlockCones = InBlocks<RoundCone>; // nearest first

// A segment of the convolution surface's field, in eye space, mm. `beyond`: how far the kernel extends past free ends.
struct FieldSegment {
    float from[3], direction[3]; // direction: of unit length
    float length, radius, slope, beyond;
};
inline constexpr FieldSegment kNoSegment{{1e9F, 1e9F, 1e9F}, {1.0F, 0.0F, 0.0F}, 1.0F, 1.0F, 0.0F, 0.0F};

// The field around each cone. Cone c uses the segments neighbours[first[c]] to neighbours[first[c + 1] - 1]; their
// number is even, because segments are evaluated in pairs.
struct Field {
    const FieldSegment* segments; // null: the cones themselves are the surface
    const std::uint32_t* first;
    const std::uint32_t* neighbours;
    float root_width, isovalue; // of the kernel
    // The neighbours of a cone that belong to another layer; their number is even, too.
    const std::uint32_t *first_other, *other_layer;
    const std::uint32_t* branch; // of each segment
    const Layer* layer;          // of its branch
};

// A tile to cast, with what every stage needs.
struct TileTask {
    const View& view;
    const Field& field;
    bool with_values; // the colour depends on a value along the vessels
    int x, y;         // lower left pixel
};

inline constexpr std::uint32_t kNoCone = ~0U;

// Nearest hit of every sample of a tile, indexed [block][sample][4 * row + column].
struct alignas(64) Samples {
    float depth[kBlocks * kBlocks][kSamples][kBlockPixels];
    std::uint32_t id[kBlocks * kBlocks][kSamples][kBlockPixels];
    std::uint32_t normal[kBlocks * kBlocks][kSamples][kBlockPixels]; // octahedral, y up and z towards the eye
    float value[kBlocks * kBlocks][kSamples][kBlockPixels];
    std::uint32_t cone[kBlocks * kBlocks][kBlockPixels]; // hit by the first sample; kNoCone: a triangle
    float farthest[kBlocks * kBlocks];                   // largest depth in each block
    bool touched[kBlocks * kBlocks]; // false: the block is empty and its other entries are undefined
};

// Records to shade: one for a pixel that shows one surface, one per sample on edges.
inline constexpr std::uint32_t kPixelMask = kTilePixels - 1, kSampleShift = 10, kWhole = 1U << 12,
                               kPair = 1U << 13; // this sample and the next
struct Records {
    std::uint32_t* position; // pixel of the tile | sample << kSampleShift; kWhole: all samples, kPair: two samples
    std::uint32_t* id;
    std::uint32_t* normal;
    float* depth;
    float* value; // null: none
    std::size_t count;
};

// A pixel of a tile that shows slices of a scan.
struct SlicePixel {
    std::uint16_t at;               // y * kTile + x
    std::uint8_t samples;           // a bit for each that shows a slice
    std::uint32_t colour[kSamples]; // sRGB bytes, red lowest, of these samples
};

// Arrays of the whole picture, rows `stride` apart.
struct PictureArrays {
    float* depth;          // nearest opaque surface; kNothing: none
    float* picked_depth;   // nearest of anything
    std::uint32_t* id;     // of what `picked_depth` belongs to; 0: nothing
    std::uint32_t* normal; // of the nearest opaque surface
    // `depth` again, split into four planes: plane k has the columns k, k + 4, ... The occlusion of a vector of pixels
    // reads pixels four columns apart, which are adjacent here. Rows are `plane_stride` apart, planes `plane_size`.
    float* depth_planes;
    std::ptrdiff_t plane_stride, plane_size;
    struct Taken {     // share of the light that is hidden
        float* rough;  // before denoising
        float* smooth; // after denoising
    };
    Taken sky, key; // hidden by ambient occlusion; by shadows
};

// All uniform blocks of shade.frag.
struct Uniforms : ViewBlock, LookBlock, SceneBlock {};

// Distances to lesions with meshes, in mm, sampled on a grid, x fastest.
struct LesionGrid {
    const float* values;
    int size[3];
    vec4 from_eye[3]; // rows of the matrix from eye space to grid indices
};

// Inputs of the formulas in shaders/look: uniforms, and arrays where the shaders read textures.
struct Shading {
    Uniforms uniforms;
    int width, height, stride;     // pixels
    const std::uint32_t* branches; // two words each: red, green; blue, flags
    bool outlined;
    vec2 outline_ring[12], halo_ring[12]; // offsets from a pixel to the pixels around it
    const float* ramp;                    // rgb, sRGB
    int ramp_steps;
    const vec4* lesions; // spheres: centre in eye space, radius
    LesionGrid grid;
    const float* shapes;      // LookData::shapes
    const float* slice_light; // light_of_bytes()
    const vec4* cuts;         // five per part of a branch that a cut loses, see behind_cut()
};

// A cross-section of a vessel: the circle that fits the surface best at this place.
struct CrossSection {
    float middle[3], side[3], up[3]; // centre; unit vectors in its plane; all in the space of the segments
    float radius;                    // in: of the vessel; out: of the circle
    float least, most;               // bounds of the circle's radius, in radii of the vessel
    std::uint32_t segment;           // segment at this place; its neighbours define the surface
};

} // namespace ramus::render::caster
