// Adds a pane of glass to the list of its pixel.
#version 450 core
// Variant: GLASS_SIDE cuts triangles in two where glass meets what is opaque.
#include "ids.glsl"
#include "panes.glsl"
#include "octahedral.glsl"

layout(early_fragment_tests) in; // what opaque surfaces hide is no pane

in vec3 normal_eye;
noperspective centroid in float depth_value;
flat in int branch_id;
#ifdef GLASS_SIDE
in float glassy;
layout(location = 2) uniform int samples;
#endif
layout(location = 4) uniform ivec2 pixels; // width and first row of the band that the lists are for
layout(location = 5) uniform uint room;    // panes

void main() {
    int covered = gl_SampleMaskIn[0];
#ifdef GLASS_SIDE
    for (int i = 0; i < samples; ++i) covered &= ~((interpolateAtSample(glassy, i) > 0.0 ? 0 : 1) << i);
#endif
    if (covered == 0) return;
    uint number = atomicAdd(pane_count, 1u) + 1u;
    if (number > room) return;
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uint before = atomicExchange(heads[(pixel.y - pixels.y) * pixels.x + pixel.x], number);
    // The normal is that at the pixel's centre: beyond the triangle's edge it goes on as the next one's does. The depth
    // decides what lies before what, and must be one that the triangle has, whatever hides some of it.
    float depth = gl_SampleMaskIn[0] == kAllSamples ? interpolateAtOffset(depth_value, vec2(0.0))
                                                    : interpolateAtSample(depth_value, findLSB(gl_SampleMaskIn[0]));
    panes[number] = Pane(before, uint(branch_id + 1) | (uint(covered) << kSampleShift),
                         packSnorm2x16(octahedral(normalize(normal_eye))), floatBitsToUint(depth));
}
