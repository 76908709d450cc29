// How fragments of glass are written: to the list of their pixel or, where there are none (FLOOR), as a layer.
#include "bindings.glsl"
#include "limits.glsl"
#include "glass_fragments.glsl"

noperspective centroid in float depth_value;
#ifdef FLOOR
layout(binding = kUnitOpaqueSamples) uniform sampler2DMS opaque_samples;
layout(binding = kUnitLastLayer) uniform sampler2DMS last_layer; // depths
layout(location = kUniformSamples) uniform int samples;
layout(location = kUniformLayer) uniform int layer; // 0: there is none before
layout(location = kUniformSamplePositions) uniform vec2 sample_positions[kMostSamples]; // of the samples, from the pixel's middle

layout(location = 0) out uvec2 fragment; // id and two masks of samples, as kBeforeShift and kGlassShift say

// The samples at which what is drawn lies before what is opaque, a bit each. `slope`: of gl_FragCoord.z. GLSL 3.30 has no
// interpolateAtSample(), but depth is linear in the picture.
uint samples_before(vec2 slope) {
    uint before = 0u;
    for (int s = 0; s < samples; ++s) {
        float depth = gl_FragCoord.z + dot(sample_positions[s], slope);
        before |= (depth > texelFetch(opaque_samples, ivec2(gl_FragCoord.xy), s).x ? 1u : 0u) << s;
    }
    return before;
}

// Behind the nearest of the pixel's fragments in the layer before.
bool behind_last_layer() {
    float last = layer == 0 ? 2.0 : 0.0;
    for (int s = 0; s < samples && layer > 0; ++s)
        last = max(last, texelFetch(last_layer, ivec2(gl_FragCoord.xy), s).x);
    return depth_value < last;
}
#else
layout(early_fragment_tests) in; // what opaque surfaces hide is no fragment
layout(location = kUniformBand) uniform ivec2 pixels; // width and first row of the band that the lists are for
layout(location = kUniformCapacity) uniform uint capacity; // fragments

void add_fragment(uint id, uint normal, int covered) {
    if (covered == 0) return;
    uint number = atomicAdd(fragment_count, 1u) + 1u;
    if (number > capacity) return;
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uint before = atomicExchange(heads[(pixel.y - pixels.y) * pixels.x + pixel.x], number);
    // The depth decides what lies before what, and must be one that the triangle has, whatever hides some of it.
    float depth = gl_SampleMaskIn[0] == kAllSamples ? interpolateAtOffset(depth_value, vec2(0.0))
                                                    : interpolateAtSample(depth_value, first_sample(gl_SampleMaskIn[0]));
    fragments[number] = GlassFragment(before, id | (uint(covered) << kSampleShift), normal, floatBitsToUint(depth));
}
#endif
