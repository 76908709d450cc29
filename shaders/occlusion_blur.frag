// Removes the noise of occlusion and shadows along one axis, without mixing a vessel with another behind it.
#include "view.glsl"
#include "look/occlusion.glsl"

layout(binding = kUnitOcclusion) uniform sampler2D occlusion;
layout(binding = kUnitOpaqueDepth) uniform sampler2D opaque_depth;
layout(location = kUniformAlong) uniform ivec2 along;

layout(location = 0) out vec2 blurred;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(opaque_depth, pixel, 0).x;
    blurred = vec2(0.0);
    if (depth >= kNothing) return;
    float per_tolerance = blur_tolerance_inverse(depth);
    ivec2 last = ivec2(picture.xy) - 1;
    vec2 sum = vec2(0.0);
    float weights = 0.0;
    for (int i = -3; i <= 3; ++i) {
        ivec2 tap = clamp(pixel + i * along, ivec2(0), last);
        float weight = blur_weight(i, texelFetch(opaque_depth, tap, 0).x - depth, per_tolerance);
        sum += weight * texelFetch(occlusion, tap, 0).xy;
        weights += weight;
    }
    blurred = sum / weights;
}
