// What context meshes and lesions look like.
#include "bindings.glsl"
layout(binding = kUnitContext) uniform samplerBuffer context_meshes; // linear colour, opacity; negative: lines

// By an id (ids.glsl) or a fragment's (glass_fragments.glsl).
vec4 context_mesh(uint id) { return texelFetch(context_meshes, int(id & kNumberBits) - 1); }

#ifdef GLASS
// A shell of even thickness takes the more light the more aslant it is looked through: clear where it faces the eye,
// dense at its outline. Premultiplied.
vec4 context_veil(uint id, uint normal, vec3 position) {
    vec4 mesh = (id & kLesionFragment) != 0u ? lesion_colour : context_mesh(id);
    float far = clamp((position.z - depth_range.x) / (depth_range.y - depth_range.x), 0.0, 1.0);
    if (mesh.w < 0.0) {
        float share = -mesh.w * uintBitsToFloat(normal);
        return share * vec4(mix(mesh.rgb, far_colour.rgb, 0.62 * background_bottom.w * far), 1.0);
    }
    vec3 v = picture.w > 0.5 ? vec3(0.0, 0.0, 1.0) : normalize(vec3(-position.xy, position.z));
    vec3 n = unpack_normal(normal);
    float facing = clamp(dot(n, v), 0.0, 1.0);
    float veil = 1.0 - pow(1.0 - mesh.w, 1.0 / mix(0.14, 1.0, facing));
    vec3 radiance = mesh.rgb * (0.45 + 0.85 * max(0.0, dot(n, kKey)) + 0.15 * max(0.0, dot(n, kFill)));
    radiance = mix(radiance, far_colour.rgb, 0.5 * background_bottom.w * far * sqrt(far));
    float shine = lights.w * 0.22 * mesh.w * to_60(max(0.0, dot(n, normalize(kKey + v))));
    return vec4(radiance * veil + shine, clamp(veil + shine, 0.0, 1.0));
}
#endif
