// Adds a fragment of glass to the list of its pixel.
#version 450 core
// Variant: BORDER for triangles where branches meet: a fragment for each that is glass.
#include "glass_output.glsl"
#include "look/lanes.glsl"
#include "look/octahedral.glsl"

in vec3 normal_eye;
#ifdef BORDER
#include "border.glsl"
layout(location = kUniformSamples) uniform int samples;
#else
flat in int branch_id;
#endif

void main() {
    // The normal is that at the pixel's centre: beyond the triangle's edge it goes on as the next one's does.
    uint normal = packSnorm2x16(octahedral(normalize(normal_eye)));
#ifdef BORDER
    // A branch that has two corners has its samples with the first of them.
    ivec3 covered = ivec3(0);
    for (int i = 0; i < samples; ++i) {
        int corner = owner(interpolateAtSample(shares, i));
        covered[corner] |= gl_SampleMaskIn[0] & (1 << i);
    }
    for (int corner = 0; corner < 3; ++corner)
        if (layer_of(branch_ids[corner]) == 1u) add_fragment(uint(branch_ids[corner] + 1), normal, covered[corner]);
#else
    add_fragment(uint(branch_id + 1), normal, gl_SampleMaskIn[0]);
#endif
}
