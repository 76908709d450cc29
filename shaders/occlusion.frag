// Ambient occlusion from the picture's own depths: how much of the hemisphere over a point its surroundings take.
// Alchemy's estimator (McGuire et al., 2011) on a spiral of taps, turned by a noise that the blur removes.
#version 450 core
#include "view.glsl"

layout(binding = 0) uniform usampler2D id_normal;
layout(binding = 1) uniform sampler2D opaque_depth;
layout(location = 0) uniform int taps;

layout(location = 0) out float occlusion;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(opaque_depth, pixel, 0).x;
    if (depth >= kNothing) {
        occlusion = 0.0;
        return;
    }
    vec3 centre = eye_position(gl_FragCoord.xy, depth);
    vec3 n = unpack_normal(texelFetch(id_normal, pixel, 0).y) * vec3(1.0, 1.0, -1.0); // depth is +z here
    float turn = 6.2831853 * noise(gl_FragCoord.xy);
    float radius_pixels = depth_range.z;
    float radius_mm = depth_range.w * (picture.w > 0.5 ? 1.0 : depth);
    float bias = 0.02 * radius_mm;
    ivec2 last = ivec2(picture.xy) - 1;
    float sum = 0.0;
    for (int i = 0; i < taps; ++i) {
        float fraction = (float(i) + 0.5) / float(taps);
        float angle = turn + 2.3999632 * float(i);
        // Denser towards the centre: contacts count more than far neighbours.
        vec2 offset = radius_pixels * fraction * sqrt(fraction) * vec2(cos(angle), sin(angle));
        ivec2 tap = clamp(pixel + ivec2(round(offset)), ivec2(0), last);
        float tap_depth = texelFetch(opaque_depth, tap, 0).x;
        if (tap_depth >= kNothing) continue;
        vec3 v = eye_position(vec2(tap) + 0.5, tap_depth) - centre;
        float squared = dot(v, v);
        float fall_off = max(0.0, 1.0 - squared / (4.0 * radius_mm * radius_mm));
        sum += fall_off * max(0.0, dot(v, n) - bias) / sqrt(squared + 0.01 * radius_mm * radius_mm);
    }
    occlusion = clamp(2.4 * sum / float(taps), 0.0, 1.0);
}
