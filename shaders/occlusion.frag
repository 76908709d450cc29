// Ambient occlusion of the picture's opaque surfaces, with the noise of its taps: see look/occlusion.glsl.
#include "view.glsl"
#include "look/occlusion.glsl"
#include "look/taps.glsl"

layout(binding = kUnitIdNormal) uniform usampler2D id_normal;
layout(binding = kUnitOpaqueDepth) uniform sampler2D opaque_depth;
layout(location = kUniformTaps) uniform int taps;
layout(location = kUniformTurned) uniform float turned; // all of them, of a sixteenth of the way around

layout(location = 0) out float occlusion;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(opaque_depth, pixel, 0).x;
    occlusion = 0.0;
    if (depth >= kNothing) return;
    vec3 centre = eye_position(gl_FragCoord.xy, depth);
    vec3 n = unpack_normal(texelFetch(id_normal, pixel, 0).y) * vec3(1.0, 1.0, -1.0); // depth is +z here
    float turn = first_turn(pixel.x, pixel.y) + 0.39269908 * turned;
    OcclusionScale scale = occlusion_scale(depth);
    ivec2 last = ivec2(picture.xy) - 1;
    float sum = 0.0;
    vec2 direction = vec2(cos(turn), sin(turn));
    const mat2 kGolden = mat2(-0.73736887, 0.67549029, -0.67549029, -0.73736887); // by the golden angle
    for (int i = 0; i < taps; ++i) {
        vec2 offset = depth_range.z * tap_distance(i, taps) * direction;
        direction = kGolden * direction;
        ivec2 tap = pixel + ivec2(round(offset));
        if (clamp(tap, ivec2(0), last) != tap) continue;
        float tap_depth = texelFetch(opaque_depth, tap, 0).x;
        if (tap_depth >= kNothing) continue;
        sum = with_tap(sum, eye_position(vec2(tap) + 0.5, tap_depth) - centre, n, scale);
    }
    occlusion = occlusion_of_sum(sum, float(taps));
}
