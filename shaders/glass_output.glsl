// Writes fragments of glass: to the list of their pixel or, without lists (FALLBACK), layer by layer: of the fragments
// behind the last layer the nearest is kept, sample by sample. See passes/glass_pass.h.
#include "glass_fragments.glsl"

centroid in vec2 clip_depth; // z and w; geometry.vert says why
layout(location = kUniformSamples) uniform int samples;
#ifdef FALLBACK
layout(binding = kUnitLastLayer) uniform sampler2DMS last_layer; // depths
layout(location = kUniformLayer) uniform int layer; // 0: no previous layer
layout(location = kUniformSamplePositions) uniform vec2 sample_positions[kMostSamples]; // of the samples, from the pixel's middle

layout(location = 0) out uvec2 fragment; // id and two masks of samples, see kBeforeShift and kGlassShift

int covered_samples() { return kAllSamples; } // unknown in GLSL 3.30

// Discards if there is no fragment to add.
void add_fragment(uint id, uint normal, int glass) {
    // GLSL 3.30 has no interpolateAtSample(), but depth is linear in the picture.
    vec2 slope = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uint before = 0u; // a bit per sample at which the fragment is in front of opaque surfaces
    float last = layer == 0 ? 2.0 : 0.0; // depth of the pixel's nearest fragment in the previous layer
    for (int s = 0; s < samples; ++s) {
        float depth = gl_FragCoord.z + dot(sample_positions[s], slope);
        before |= (depth > texelFetch(opaque_samples, pixel, s).x ? 1u : 0u) << s;
        if (layer > 0) last = max(last, texelFetch(last_layer, pixel, s).x);
    }
    float depth = clip_depth.x / clip_depth.y;
    if (before == 0u || glass == 0 || !(depth < last)) discard;
    fragment = uvec2(id | (before << kBeforeShift) | (uint(glass) << kGlassShift), normal);
    gl_FragDepth = depth;
}
#else
layout(early_fragment_tests) in; // fragments behind opaque surfaces are dropped
layout(location = kUniformCapacity) uniform uint capacity; // fragments

int covered_samples() { return gl_SampleMaskIn[0]; }

void add_fragment(uint id, uint normal, int covered) {
    if (covered == 0) return;
    uint number = atomicAdd(fragment_count, 1u) + 1u;
    if (number > capacity) return;
    uint before = atomicExchange(heads[list_of(ivec2(gl_FragCoord.xy))], number);
    // The depth determines the order, and must occur on the triangle, whatever hides part of it. Where no sample is
    // covered, as next to a triangle, a software rasteriser still executes the shader, so a sample must be chosen.
    vec2 at = covered_samples() == kAllSamples ? interpolateAtOffset(clip_depth, vec2(0.0))
                                               : interpolateAtSample(clip_depth, max(findLSB(covered_samples()), 0));
    float depth = at.x / at.y;
    fragments[number] = GlassFragment(before, id | (uint(covered) << kSampleShift), normal, floatBitsToUint(depth));
}
#endif
