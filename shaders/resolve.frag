// One value a pixel from the samples: the nearest opaque surface, else the nearest glass. Picking, outlines and the
// occlusion read this.
#version 450 core
#include "view.glsl"
#include "ids.glsl"

layout(binding = 0) uniform usampler2DMS surface_samples;
layout(binding = 1) uniform sampler2DMS depth_samples;
layout(binding = 2) uniform usampler2DMS glass_samples;
layout(binding = 3) uniform sampler2DMS glass_depth_samples;
layout(location = 0) uniform bool has_glass;

layout(location = 0) out uvec2 id_normal;
layout(location = 1) out float opaque_depth; // for the occlusion: opaque surfaces only
layout(location = 2) out float picked_depth; // of id_normal

// Software rasterisers execute both sides of a branch: fetch what is needed, not what might be.
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int samples = int(picture.z), seen = 0;
    float nearest = 0.0; // reversed depth: larger is nearer
    for (int s = 0; s < samples; ++s) {
        float depth = texelFetch(depth_samples, pixel, s).x;
        seen = depth > nearest ? s : seen;
        nearest = max(nearest, depth);
    }
    id_normal = texelFetch(surface_samples, pixel, seen).xy;
    opaque_depth = id_normal.x == 0u ? kNothing : eye_depth(nearest);
    picked_depth = opaque_depth;
    if (has_glass) {
        // Lines are picked as their branch; they take no light from what they run before.
        float solid = 0.0;
        for (int s = 0; s < samples; ++s) {
            float depth = texelFetch(depth_samples, pixel, s).x;
            bool line = (texelFetch(surface_samples, pixel, s).x & kLine) != 0u;
            solid = line ? solid : max(solid, depth);
        }
        opaque_depth = solid > 0.0 ? eye_depth(solid) : kNothing;
        id_normal.x &= ~kLine;
        float pane = 0.0;
        seen = 0;
        for (int s = 0; s < samples; ++s) {
            float depth = texelFetch(glass_depth_samples, pixel, s).x;
            seen = depth > pane ? s : seen;
            pane = max(pane, depth);
        }
        if (id_normal.x == 0u) {
            id_normal = texelFetch(glass_samples, pixel, seen).xy;
            nearest = pane;
            if (id_normal.x != 0u) picked_depth = eye_depth(pane);
        }
    }
    gl_FragDepth = nearest;
}
