// Glass as a list of fragments per pixel: one per triangle that covers any of the pixel's samples. Lists are built in
// any order and then sorted, nearest first, so that the picture does not depend on the order of triangles.
#ifdef FALLBACK
layout(binding = kUnitOpaqueSamples) uniform sampler2DMS opaque_samples;

// Replaces the mask of covered samples, which 3.30 cannot read: the samples in front of opaque surfaces, if they are
// covered, and the samples on the glass side of a border to an opaque branch.
const int kBeforeShift = 24, kGlassShift = 28;
const uint kIdBits = 0x00ffffffu, kContextFragment = 0x00800000u;
#else
struct GlassFragment {
    uint next;           // its number, 0 at the end
    uint id_and_samples; // id as in ids.glsl, and from kSampleShift on a bit per covered sample
    uint normal;         // octahedral
    uint depth;          // bits of the depth value, larger is nearer
};

layout(std430, binding = kStorageHeads) buffer Heads { uint heads[]; };                    // by pixel: its first fragment; 0: none
layout(std430, binding = kStorageFragments) buffer Fragments { GlassFragment fragments[]; }; // fragments[0] is unused
layout(std430, binding = kStorageCount) buffer Count { uint fragment_count; }; // also counts those that do not fit
layout(location = kUniformBand) uniform ivec2 band; // width and first row of the band that the lists are for

int list_of(ivec2 pixel) { return (pixel.y - band.y) * band.x + pixel.x; }

const int kSampleShift = 28;
const uint kIdBits = 0x0fffffffu, kContextFragment = 0x08000000u;
#endif
// kContextFragment: belongs to a context mesh or, with kLesionFragment, to a lesion, by its number + 1, instead of a
// branch. For meshes drawn as lines, `normal` has the bits of the line's share of the pixel.
const int kAllSamples = 15;
