// Ambient occlusion from the picture's own depths: how much of the hemisphere over a point its surroundings take.
// Alchemy's estimator (McGuire et al., 2011) on a spiral of taps, turned in sixteen ways within every four by four
// pixels: the blur, two boxes of four one after the other, takes their mean.
#version 450 core
#include "bindings.glsl"
#include "view.glsl"

layout(binding = kUnitIdNormal) uniform usampler2D id_normal;
layout(binding = kUnitOpaqueDepth) uniform sampler2D opaque_depth;
layout(location = kUniformTaps) uniform int taps;
layout(location = kUniformTurned) uniform float turned; // all of them, of a sixteenth of the way around

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
    const int kFine[4] = int[4](0, 2, 1, 3);
    float turn = 0.39269908 * (float(4 * ((pixel.x + pixel.y) & 3) + kFine[pixel.y & 3]) + turned);
    float radius_pixels = depth_range.z;
    float radius_mm = depth_range.w * (picture.w > 0.5 ? 1.0 : depth);
    float bias = 0.02 * radius_mm, softness = 0.01 * radius_mm * radius_mm;
    float fall_off_per_mm2 = 0.25 / (radius_mm * radius_mm);
    ivec2 last = ivec2(picture.xy) - 1;
    float sum = 0.0;
    vec2 direction = vec2(cos(turn), sin(turn));
    const mat2 kGolden = mat2(-0.73736887, 0.67549029, -0.67549029, -0.73736887); // by the golden angle
    for (int i = 0; i < taps; ++i) {
        float fraction = (float(i) + 0.5) / float(taps);
        // Denser towards the centre: contacts count more than far neighbours.
        vec2 offset = radius_pixels * fraction * sqrt(fraction) * direction;
        direction = kGolden * direction;
        ivec2 tap = pixel + ivec2(round(offset));
        if (clamp(tap, ivec2(0), last) != tap) continue;
        float tap_depth = texelFetch(opaque_depth, tap, 0).x;
        if (tap_depth >= kNothing) continue;
        vec3 v = eye_position(vec2(tap) + 0.5, tap_depth) - centre;
        float squared = dot(v, v);
        float fall_off = max(0.0, 1.0 - squared * fall_off_per_mm2);
        sum += fall_off * max(0.0, dot(v, n) - bias) * inversesqrt(squared + softness);
    }
    occlusion = clamp(2.4 * sum / float(taps), 0.0, 1.0);
}
