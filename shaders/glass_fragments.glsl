// Glass as a list of fragments a pixel: one for each triangle of it that covers any of the pixel's samples. The lists are
// made in any order and sorted afterwards, nearest first, so that the picture does not depend on the order of triangles.
#ifdef FLOOR
layout(binding = kUnitOpaqueSamples) uniform sampler2DMS opaque_samples;

// In place of a mask of samples that are covered, which 3.30 cannot tell: those before what is opaque, if they are
// covered, and those on the glass's side where it meets what is opaque.
const int kBeforeShift = 24, kGlassShift = 28;
const uint kIdBits = 0x00ffffffu, kContextFragment = 0x00800000u;
#else
struct GlassFragment {
    uint next;           // its number, 0 at the end
    uint id_and_samples; // id as in ids.glsl, and from kSampleShift on a bit for each sample that it covers
    uint normal;         // octahedral
    uint depth;          // bits of the depth value, larger is nearer
};

layout(std430, binding = kStorageHeads) buffer Heads { uint heads[]; };                    // by pixel: its first fragment; 0: none
layout(std430, binding = kStorageFragments) buffer Fragments { GlassFragment fragments[]; }; // fragments[0] is none
layout(std430, binding = kStorageCount) buffer Count { uint fragment_count; };             // of all, also of those beyond the capacity
layout(location = kUniformBand) uniform ivec2 band; // width and first row of the band that the lists are for

int list_of(ivec2 pixel) { return (pixel.y - band.y) * band.x + pixel.x; }

const int kSampleShift = 28;
const uint kIdBits = 0x0fffffffu, kContextFragment = 0x08000000u;
#endif
// kContextFragment: not of a branch but of a context mesh or, with kLesionFragment, of a lesion, by its number + 1. Of a mesh
// that is lines, the normal is the bits of the share that the line has of the pixel.
const int kAllSamples = 15;
