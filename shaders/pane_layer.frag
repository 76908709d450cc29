// Glass without lists, layer by layer: of the panes that lie behind the last layer's, the nearest stays, sample by
// sample. See passes/peeling.cpp.
#version 450 core
// Variant: GLASS_SIDE cuts triangles in two where glass meets what is opaque.
#include "panes.glsl"
#include "octahedral.glsl"

in vec3 normal_eye;
noperspective centroid in float depth_value;
flat in int branch_id;
#ifdef GLASS_SIDE
in float glassy;
#endif
layout(binding = 5) uniform sampler2DMS opaque_samples;
layout(binding = 6) uniform sampler2DMS last_layer; // depths
layout(location = 2) uniform int samples;
layout(location = 4) uniform int layer; // 0: there is none before
layout(location = 8) uniform vec2 places[4]; // of the samples, from the pixel's middle

layout(location = 0) out uvec2 pane; // id and two masks of samples, as kBeforeShift and kGlassShift say

// What is linear in the picture, at a sample: GLSL 3.30 has no interpolateAtSample().
float at_sample(float value, vec2 slope, int s) { return value + dot(places[s], slope); }

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 slope = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));
#ifdef GLASS_SIDE
    float side = glassy * gl_FragCoord.w; // over w it is linear, and has the same sign
    vec2 side_slope = vec2(dFdx(side), dFdy(side));
#endif
    float last = layer == 0 ? 2.0 : 0.0;
    uint masks = 0u;
    for (int s = 0; s < samples; ++s) {
        if (layer > 0) last = max(last, texelFetch(last_layer, pixel, s).x);
        bool before = at_sample(gl_FragCoord.z, slope, s) > texelFetch(opaque_samples, pixel, s).x, is_glass = true;
#ifdef GLASS_SIDE
        is_glass = at_sample(side, side_slope, s) > 0.0;
#endif
        masks |= ((before ? 1u << kBeforeShift : 0u) | (is_glass ? 1u << kGlassShift : 0u)) << s;
    }
    if (((masks >> kBeforeShift) & 15u) == 0u || (masks >> kGlassShift) == 0u || depth_value >= last) discard;
    pane = uvec2(uint(branch_id + 1) | masks, packSnorm2x16(octahedral(normalize(normal_eye))));
    gl_FragDepth = depth_value;
}
