// What a point of the surface means: how far it is from the lesions, how wide its vessel is there, before or behind a
// cut. Eye space with depth as +z, mm.
#include "bindings.glsl"
#include "limits.glsl"
layout(std140, binding = kBlockScene) uniform Scene {
#include "scene_block.glsl"
};

layout(binding = kUnitLinePoints) uniform samplerBuffer line_points;     // position, mm from the root
layout(binding = kUnitLineDetails) uniform usamplerBuffer line_details;  // bits of the diameter, branch
layout(binding = kUnitLineRuns) uniform usamplerBuffer line_runs;     // first point, count
layout(binding = kUnitLesions) uniform samplerBuffer lesion_spheres; // centre in eye space, radius
layout(binding = kUnitCuts) uniform samplerBuffer cut_ends;      // five texels a part that is lost, see behind_cut()
layout(binding = kUnitRamp) uniform sampler1D ramp;              // sRGB
layout(binding = kUnitDistances) uniform sampler3D lesion_distances;  // mm

#if defined(SCALE) || defined(CUTS)
// The nearest point of the branch's centerline: mm from the root, diameter. Long runs are looked at in some 24 steps.
vec2 point_along(int branch, vec3 position) {
    vec3 p = (eye_to_lines * vec4(position, 1.0)).xyz;
    uvec2 run = texelFetch(line_runs, branch).xy;
    int first = int(run.x), last = first + int(run.y) - 1, stride = max(1, (int(run.y) + 22) / 24);
    float nearest = 1e30, fraction = 0.0;
    int from = first, to = first;
    vec3 a = texelFetch(line_points, first).xyz;
    for (int i = first; i < last; i += stride) {
        int next = min(i + stride, last);
        vec3 b = texelFetch(line_points, next).xyz, ab = b - a, ap = p - a;
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
    return mix(vec2(texelFetch(line_points, from).w, uintBitsToFloat(texelFetch(line_details, from).x)),
               vec2(texelFetch(line_points, to).w, uintBitsToFloat(texelFetch(line_details, to).x)), fraction);
}
#endif

#ifdef SCALE
// Linear. Branches without a centerline have their own colour.
vec3 colour_on_scale(int branch, vec3 position, vec3 otherwise) {
    if (texelFetch(line_runs, branch).y < 2u) return otherwise;
    vec2 point = point_along(branch, position);
    float value = scale.w > 0.5 ? point.x : point.y;
    value = scale.z > 0.5 ? log(max(value, 1e-12)) : value;
    return to_linear(texture(ramp, clamp((value - scale.x) * scale.y, 0.0, 1.0)).rgb);
}
#endif

#ifdef MARGINS
float distance_to_lesions(vec3 position) {
    float nearest = 1e30;
    for (int i = 0; i < int(counts.x); ++i) {
        vec4 sphere = texelFetch(lesion_spheres, i);
        nearest = min(nearest, distance(position, sphere.xyz) - sphere.w);
    }
    if (counts.w > 0.5) {
        vec3 at = (eye_to_grid * vec4(position, 1.0)).xyz;
        float there = texture(lesion_distances, at).x;
        bool inside = all(greaterThanEqual(at, vec3(0.0))) && all(lessThanEqual(at, vec3(1.0)));
        nearest = inside ? min(nearest, there) : nearest;
    }
    return nearest;
}

// Linear. Steps from band to band are as sharp as the pixels are, with a thin dark line between.
vec3 margin_colour(vec3 position) {
    float mm = distance_to_lesions(position);
    float pixel_mm = pixel_to_eye.z * (picture.w > 0.5 ? 1.0 : position.z);
    vec3 found = beyond.rgb;
    float edge = 1.0;
    for (int i = int(counts.z) - 1; i >= 0; --i) {
        float inside = margins[i].w - mm;
        found = mix(found, margins[i].rgb, clamp(inside / pixel_mm + 0.5, 0.0, 1.0));
        edge = min(edge, abs(inside) / (pixel_mm * more.z));
    }
    return found * mix(0.45, 1.0, smoothstep(0.5, 1.3, edge));
}
#endif

#ifdef CUTS
// How far outward of an end of a part, in mm. Near it its plane decides, farther away the way along the branch, which
// may turn back.
float outward_of(int texel, float from_root, vec3 position) {
    vec4 centre = texelFetch(cut_ends, texel), along = texelFetch(cut_ends, texel + 1);
    float way = from_root - along.w;
    return abs(way) < 2.5 * centre.w ? dot(position - centre.xyz, along.xyz) : way;
}

// How far inside the lost part of its branch, in mm; negative outside.
float behind_cut(int branch, vec3 position) {
    float inside = -1e30;
    float from_root = point_along(branch, position).x;
    for (int i = 0; i < int(counts.y); ++i) {
        vec4 part = texelFetch(cut_ends, 5 * i);
        if (int(part.x) != branch) continue;
        float from = part.y > 0.5 ? outward_of(5 * i + 1, from_root, position) : 1e30;
        float to = part.z > 0.5 ? -outward_of(5 * i + 3, from_root, position) : 1e30;
        inside = max(inside, min(from, to));
    }
    return inside;
}
#endif
