// Adds a fragment of glass to the list of its pixel.
#version 450 core
// Variant: BORDER for triangles where branches meet: a fragment for each that is glass.
#include "bindings.glsl"
#include "glass_fragments.glsl"
#include "look/lanes.glsl"
#include "look/octahedral.glsl"

layout(early_fragment_tests) in; // what opaque surfaces hide is no fragment

in vec3 normal_eye;
noperspective centroid in float depth_value;
#ifdef BORDER
#include "border.glsl"
layout(location = kUniformSamples) uniform int samples;
#else
flat in int branch_id;
#endif
layout(location = kUniformBand) uniform ivec2 pixels; // width and first row of the band that the lists are for
layout(location = kUniformCapacity) uniform uint capacity; // fragments

void add_fragment(int branch, int covered) {
    if (covered == 0) return;
    uint number = atomicAdd(fragment_count, 1u) + 1u;
    if (number > capacity) return;
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uint before = atomicExchange(heads[(pixel.y - pixels.y) * pixels.x + pixel.x], number);
    // The normal is that at the pixel's centre: beyond the triangle's edge it goes on as the next one's does. The depth
    // decides what lies before what, and must be one that the triangle has, whatever hides some of it.
    float depth = gl_SampleMaskIn[0] == kAllSamples ? interpolateAtOffset(depth_value, vec2(0.0))
                                                    : interpolateAtSample(depth_value, first_sample(gl_SampleMaskIn[0]));
    fragments[number] = GlassFragment(before, uint(branch + 1) | (uint(covered) << kSampleShift),
                         packSnorm2x16(octahedral(normalize(normal_eye))), floatBitsToUint(depth));
}

void main() {
#ifdef BORDER
    // A branch that has two corners has its samples with the first of them.
    ivec3 covered = ivec3(0);
    for (int i = 0; i < samples; ++i) {
        int corner = owner(interpolateAtSample(shares, i));
        covered[corner] |= gl_SampleMaskIn[0] & (1 << i);
    }
    for (int corner = 0; corner < 3; ++corner)
        if (layer_of(branch_ids[corner]) == 1u) add_fragment(branch_ids[corner], covered[corner]);
#else
    add_fragment(branch_id, gl_SampleMaskIn[0]);
#endif
}
