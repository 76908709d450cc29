// Ambient occlusion of the picture's opaque surfaces, not yet blurred: see look/occlusion.glsl. Variant: SHADOWS also
// computes shadows, not yet blurred: see look/shadow.glsl.
#include "view.glsl"
#include "look/occlusion.glsl"
#include "look/taps.glsl"

layout(binding = kUnitIdNormal) uniform usampler2D id_normal;
layout(binding = kUnitOpaqueDepth) uniform sampler2D opaque_depth;
layout(location = kUniformTaps) uniform int taps;
layout(location = kUniformTurned) uniform float turned; // all of them, of a sixteenth of the way around

float opaque_depth_at(vec2 at) {
    return texelFetch(opaque_depth, clamp(ivec2(at), ivec2(0), ivec2(picture.xy) - 1), 0).x;
}
#include "look/shadow_ray.glsl"
#include "look/shadow.glsl"

layout(location = 0) out vec2 taken; // of the sky; of the key light

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(opaque_depth, pixel, 0).x;
    taken = vec2(0.0);
    if (depth >= kNothing) return;
    vec3 centre = eye_position(gl_FragCoord.xy, depth);
    vec3 normal = unpack_normal(texelFetch(id_normal, pixel, 0).y);
    vec3 n = normal * vec3(1.0, 1.0, -1.0); // depth is +z here
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
    taken.x = occlusion_of_sum(sum, float(taps));
#ifdef SHADOWS
    taken.y = shadowed(centre, normal, shadow_ray(pixel.x, pixel.y, turned));
#endif
}
