// Inputs of look/material.glsl: the nearest point of a branch's centerline, scales, lesions and cuts. Eye space with
// depth as +z, mm.
layout(std140, binding = kBlockScene) uniform Scene {
#include "scene_block.glsl"
};

#include "lines.glsl"
layout(binding = kUnitLineRuns) uniform usamplerBuffer line_runs;     // first point, count
layout(binding = kUnitLesions) uniform samplerBuffer lesion_spheres; // centre in eye space, radius
layout(binding = kUnitCuts) uniform samplerBuffer cut_ends;          // five texels per lost part, see behind_cut()
layout(binding = kUnitRamp) uniform sampler1D ramp;              // sRGB
layout(binding = kUnitDistances) uniform sampler3D lesion_distances;  // mm

#if defined(SCALE) || defined(CUTS)
// The nearest point of the branch's centerline: mm from the root, diameter. Long runs are searched in about 24 steps.
vec2 point_along(int branch, vec3 position) {
    vec3 p = (eye_to_lines * vec4(position, 1.0)).xyz;
    uvec2 run = texelFetch(line_runs, branch).xy;
    int first = int(run.x), last = first + int(run.y) - 1, stride = max(1, (int(run.y) + 22) / 24);
    float nearest = 1e30, fraction = 0.0;
    int from = first, to = first;
    vec3 a = line_point(first);
    for (int i = first; i < last; i += stride) {
        int next = min(i + stride, last);
        vec3 b = line_point(next), ab = b - a, ap = p - a;
        float t = clamp(dot(ap, ab) / max(dot(ab, ab), 1e-12), 0.0, 1.0);
        vec3 away = ap - t * ab;
        float squared = dot(away, away);
        bool nearer = squared < nearest;
        nearest = nearer ? squared : nearest;
        fraction = nearer ? t : fraction;
        from = nearer ? i : from;
        to = nearer ? next : to;
        a = b;
    }
    return mix(vec2(texelFetch(line_points, from).w, line_diameter(from)),
               vec2(texelFetch(line_points, to).w, line_diameter(to)), fraction);
}
#endif

#ifdef SCALE
// The surface's value, or mm along the centerline; unknown for branches without a centerline.
float value_on_scale(SurfacePoint p) {
#ifdef VALUES
    if (scale.w > 2.5) return p.value;
#endif
    int branch = int(p.id) - 1;
    if (texelFetch(line_runs, branch).y < 2u) return kNotKnown;
    vec2 point = point_along(branch, p.position);
    return scale.w > 1.5 ? point.x : point.y;
}
// The ends of the scale are at the centres of the first and last texel.
vec3 ramp_colour(float along) {
    float steps = float(textureSize(ramp, 0));
    return texture(ramp, (along * (steps - 1.0) + 0.5) / steps).rgb;
}
#endif

#ifdef MARGINS
vec4 lesion_sphere(int i) { return texelFetch(lesion_spheres, i); }

// 1e30 outside the grid.
float distance_in_grid(vec3 position) {
    vec3 at = (eye_to_grid * vec4(position, 1.0)).xyz;
    float there = texture(lesion_distances, at).x;
    bool inside = all(greaterThanEqual(at, vec3(0.0))) && all(lessThanEqual(at, vec3(1.0)));
    return inside ? there : 1e30;
}
#endif

#ifdef CUTS
vec4 cut_texel(int i) { return texelFetch(cut_ends, i); }
float root_distance(SurfacePoint p) { return point_along(int(p.id) - 1, p.position).x; }
#endif
