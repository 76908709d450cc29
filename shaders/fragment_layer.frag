// Glass without lists, layer by layer: of the fragments that lie behind the last layer's, the nearest stays, sample by
// sample. See LayerPass (passes/glass_pass.h).
#version 450 core
// Variant: BORDER for triangles where branches meet, of which the samples of glass are drawn.
#include "bindings.glsl"
#include "limits.glsl"
#include "glass_fragments.glsl"
#include "look/lanes.glsl"
#include "look/octahedral.glsl"

in vec3 normal_eye;
noperspective centroid in float depth_value;
#ifdef BORDER
#include "border.glsl"
#else
flat in int branch_id;
#endif
layout(binding = kUnitOpaqueSamples) uniform sampler2DMS opaque_samples;
layout(binding = kUnitLastLayer) uniform sampler2DMS last_layer; // depths
layout(location = kUniformSamples) uniform int samples;
layout(location = kUniformLayer) uniform int layer; // 0: there is none before
layout(location = kUniformSamplePositions) uniform vec2 sample_positions[kMostSamples]; // of the samples, from the pixel's middle

layout(location = 0) out uvec2 fragment; // id and two masks of samples, as kBeforeShift and kGlassShift say

// What is linear in the picture, at a sample: GLSL 3.30 has no interpolateAtSample().
float at_sample(float value, vec2 slope, int s) { return value + dot(sample_positions[s], slope); }

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 slope = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));
#ifdef BORDER
    vec3 side = shares * gl_FragCoord.w; // over w they are linear, and as large beside each other
    vec3 side_x = dFdx(side), side_y = dFdy(side);
    int branch = -1; // of the samples' branches that are glass, the last: a pixel's fragment has one
#else
    int branch = branch_id;
#endif
    float last = layer == 0 ? 2.0 : 0.0;
    uint masks = 0u;
    for (int s = 0; s < samples; ++s) {
        if (layer > 0) last = max(last, texelFetch(last_layer, pixel, s).x);
        bool before = at_sample(gl_FragCoord.z, slope, s) > texelFetch(opaque_samples, pixel, s).x, is_glass = true;
#ifdef BORDER
        int here = branch_ids[owner(side + sample_positions[s].x * side_x + sample_positions[s].y * side_y)];
        is_glass = layer_of(here) == 1u;
        branch = is_glass ? here : branch;
#endif
        masks |= ((before ? 1u << kBeforeShift : 0u) | (is_glass ? 1u << kGlassShift : 0u)) << s;
    }
    if (((masks >> kBeforeShift) & 15u) == 0u || (masks >> kGlassShift) == 0u || depth_value >= last) discard;
    fragment = uvec2(uint(branch + 1) | masks, packSnorm2x16(octahedral(normalize(normal_eye))));
    gl_FragDepth = depth_value;
}
