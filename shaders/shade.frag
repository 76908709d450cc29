// Shades samples by the formulas in look/: light, states, background. Computes in linear light; the result is sRGB with
// premultiplied alpha. Variants: GLASS if anything is defocused, OUTLINE if anything is selected, MARGINS to colour by
// the distance from lesions, SCALE to colour by a value along branches or, with VALUES, of the surface, CUTS if any
// branch is cut or lost, CHANGED to shade only marked branches and keep the rest of the last picture, HALOS, CONTOURS
// and CHROMADEPTH for depth cues, CONTEXT if there are context meshes or lesions. LAYER composes one layer of glass
// with the previous ones, without lists (FALLBACK). PLANES puts slices of a scan among what was shaded before
// (slice_pixel.glsl); with GUIDE it says where that is simple (slice_guide.glsl). CAPS if surfaces are cut open.
#include "view.glsl"
#include "look.glsl"
#include "look/point.glsl"
#include "scene.glsl"

layout(binding = kUnitSurface) uniform usampler2DMS surface_samples;
layout(binding = kUnitDepth) uniform sampler2DMS depth_samples;
#include "caps.glsl"
layout(binding = kUnitOpaqueDepth) uniform sampler2D opaque_depth;
layout(binding = kUnitIdNormal) uniform usampler2D id_normal;
layout(binding = kUnitOcclusion) uniform sampler2D occlusion;
layout(binding = kUnitBranches) uniform usamplerBuffer branches; // linear colour, 65535 is 1; alpha: flags of ids.glsl

#ifdef VALUES
layout(binding = kUnitValues) uniform sampler2DMS value_samples;
#endif

#ifdef GLASS
#include "glass_fragments.glsl"
#ifdef FALLBACK
layout(binding = kUnitFronts) uniform sampler2DArray fronts_of_samples; // from glass_layer.glsl, a layer per sample
#endif
#endif

#ifdef PLANES
#include "slices.glsl"
#endif
#if !defined(LAYER) && !defined(GUIDE)
layout(location = kTargetColour) out vec4 colour;
#endif

// Inputs of the formulas.
#if defined(HALOS) || defined(SHADOWS) || defined(PLANES)
float opaque_depth_at(vec2 at) {
    return texelFetch(opaque_depth, clamp(ivec2(at), ivec2(0), ivec2(picture.xy) - 1), 0).x;
}
#endif
vec2 taken_at(vec2 at) { return texelFetch(occlusion, clamp(ivec2(at), ivec2(0), ivec2(picture.xy) - 1), 0).xy; }
#ifdef OUTLINE
bool selected_at(vec2 at) {
    uint id = texelFetch(id_normal, clamp(ivec2(at), ivec2(0), ivec2(picture.xy) - 1), 0).x;
    return id != 0u && (id & kSolid) == 0u && (texelFetch(branches, int(id) - 1).a & kSelected) != 0u;
}
#endif

#include "look/ring.glsl"
#include "look/material.glsl"
#include "look/light.glsl"
#include "look/cues.glsl"
#ifdef GLASS
#include "look/glass.glsl"
#endif
#ifdef OUTLINE
#include "look/outline.glsl"
#endif
#ifdef CONTEXT
// Linear colour, opacity; negative: lines. By an id (ids.glsl) or a fragment's (glass_fragments.glsl).
layout(binding = kUnitShapes) uniform samplerBuffer shape_looks;
vec4 shape_look(uint id) { // of a context mesh or, with kLesionFragment, of a lesion
    int lesion = (id & kLesionFragment) != 0u ? 1 : 0;
    return texelFetch(shape_looks, 2 * (int(id & kNumberBits) - 1) + lesion);
}
#endif

SurfacePoint point_at(vec3 normal, vec3 position) {
    return SurfacePoint(0u, 0u, false, vec3(0.0), normal, position, way_to_eye(position), share_of_depth(position.z),
                        gl_FragCoord.xy, 0.0);
}

SurfacePoint point_of_branch(uint id, vec3 normal, vec3 position) {
    SurfacePoint p = point_at(normal, position);
    uvec4 branch = texelFetch(branches, int(id) - 1);
    p.id = id;
    p.flags = branch.a;
    p.albedo = vec3(branch.rgb) / 65535.0;
    return p;
}

vec3 shade(uint id, vec3 normal, vec3 position, vec2 taken, float value) {
#ifdef CONTEXT
    bool context = (id & kContext) != 0u;
    SurfacePoint p = point_of_branch(context ? 1u : id, normal, position);
    if (context) {
        p.flags = 0u;
        p.albedo = shape_look(id).rgb;
        p.fixed_colour = true;
    }
#else
    SurfacePoint p = point_of_branch(id, normal, position);
#endif
    p.value = value;
    return radiance_of(p, taken);
}

#ifdef GLASS
// The colour of a fragment of lists or layers.
vec4 veil_of(uint id, uint normal, vec3 position) {
#ifdef CONTEXT
    if ((id & kContextFragment) != 0u) {
        vec4 mesh = shape_look(id);
        SurfacePoint p = point_at(unpack_normal(normal), position);
        p.albedo = mesh.rgb;
        return mesh.w < 0.0 ? edge_veil(p, -mesh.w * uintBitsToFloat(normal)) : shell_veil(p, mesh.w);
    }
#endif
    return glass_veil(point_of_branch(id & kIdBits, unpack_normal(normal), position));
}
#endif

#if defined(GLASS) && !defined(LAYER)
// The glass in front of these depths of the samples: premultiplied. Front to back, per sample: a fragment veils what is
// behind it. Its light is computed once for all samples.
vec4[kMostSamples] veils_before(float values[kMostSamples], bool any) {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 front[kMostSamples];
#ifdef FALLBACK
    for (int s = 0; s < kMostSamples; ++s) front[s] = texelFetch(fronts_of_samples, ivec3(pixel, s), 0);
#else
    for (int s = 0; s < kMostSamples; ++s) front[s] = vec4(0.0);
    float clear = 1.0;
    for (uint number = any ? heads[list_of(pixel)] : 0u; number != 0u && clear > 1e-3;) {
        GlassFragment fragment = fragments[number];
        float value = uintBitsToFloat(fragment.depth);
        vec4 veil = veil_of(fragment.id_and_samples, fragment.normal, eye_position(gl_FragCoord.xy, eye_depth(value)));
        clear = 0.0;
        for (int s = 0; s < kMostSamples; ++s) {
            bool hit = ((fragment.id_and_samples >> (kSampleShift + s)) & 1u) != 0u && value > values[s];
            front[s] += hit ? (1.0 - front[s].a) * veil : vec4(0.0);
            clear = max(clear, 1.0 - front[s].a);
        }
        number = fragment.next;
    }
#endif
    return front;
}
#endif

#ifdef CHANGED
bool has_changed(uint id) {
    return id != 0u && (id & kSolid) == 0u && (texelFetch(branches, int(id & ~(kLine | kCap)) - 1).a & kChanged) != 0u;
}
#endif

#ifdef LAYER
#include "glass_layer.glsl"
#elif defined(GUIDE)
#include "slice_guide.glsl"
#elif defined(PLANES)
#include "slice_pixel.glsl"
#else
// Software rasterisers execute both sides of a branch, but leave loops early: pixels inside one surface need one
// iteration, pixels on an edge one per sample.
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int samples = int(picture.z);
#ifdef CHANGED
    // Pixels without a sample of a changed branch skip the loop below, and are kept.
    bool changed = false;
    for (int s = 0; s < samples; ++s) changed = changed || has_changed(texelFetch(surface_samples, pixel, s).x);
#if defined(GLASS) && !defined(FALLBACK)
    for (uint number = heads[list_of(pixel)]; number != 0u && !changed; number = fragments[number].next)
        changed = (fragments[number].id_and_samples & kContextFragment) == 0u &&
                  has_changed(fragments[number].id_and_samples & kIdBits);
#endif
    samples = changed ? samples : 0;
#endif
    vec4 behind = background_top.w > 0.5 ? vec4(0.0) : vec4(to_linear(background(gl_FragCoord.y / picture.y)), 1.0);
    vec2 taken = taken_at(gl_FragCoord.xy);

    uvec2 first = texelFetch(surface_samples, pixel, 0).xy;
    bool whole = first.x != 0u;
    vec3 first_normal = unpack_normal(first.y), mean_normal = first_normal;
    float first_depth = sample_value(pixel, 0), mean_depth = first_depth;
    for (int s = 1; s < samples; ++s) {
        uvec2 found = texelFetch(surface_samples, pixel, s).xy;
        vec3 normal = unpack_normal(found.y);
        whole = whole && found.x == first.x && dot(normal, first_normal) > 0.7;
        mean_normal += normal;
        mean_depth += sample_value(pixel, s);
    }
    mean_depth /= float(samples);
    float mean_of_values = 0.0; // mixes known and unknown values as interpolation does
#ifdef VALUES
    for (int s = 0; s < samples; ++s) mean_of_values += texelFetch(value_samples, pixel, s).x / float(samples);
#endif

#ifdef GLASS
    float opaque_values[kMostSamples];
    bool empty = true;
    for (int s = 0; s < kMostSamples; ++s) {
        opaque_values[s] = s < samples ? sample_value(pixel, s) : 0.0;
        empty = empty && opaque_values[s] == 0.0;
    }
    vec4 front[kMostSamples] = veils_before(opaque_values, true);
    vec4 mean_front = vec4(0.0);
    for (int s = 0; s < kMostSamples; ++s) mean_front += s < samples ? front[s] : vec4(0.0);
    mean_front /= float(max(samples, 1));
    whole = whole || empty; // only glass: all samples have the same background
#endif

    vec4 sum = vec4(0.0);
    bool bare = true;
    int rounds = samples == 0 ? 0 : whole ? 1 : samples;
    for (int s = 0; s < rounds; ++s) {
        uvec2 found = texelFetch(surface_samples, pixel, s).xy;
        float value = whole ? mean_depth : sample_value(pixel, s);
        vec3 normal = whole ? normalize(mean_normal) : unpack_normal(found.y);
        vec3 position = eye_position(gl_FragCoord.xy, eye_depth(value));
        found.x &= ~kCap;
#ifdef GLASS
        bool is_line = (found.x & kLine) != 0u;
        found.x &= ~kLine;
#endif
#ifdef SHADOWS
        if (!whole) taken = taken_beside(gl_FragCoord.xy, position.z);
#endif
        float own_value = mean_of_values;
#ifdef VALUES
        if (!whole) own_value = texelFetch(value_samples, pixel, s).x;
#endif
        vec4 here = vec4(shade(max(found.x, 1u), normal, position, taken, own_value), 1.0);
        if (found.x == 0u) here = behind;
        bare = bare && found.x == 0u;
#ifdef GLASS
        if (is_line) here.rgb = line_radiance(point_of_branch(found.x, normal, position));
        vec4 before = whole ? mean_front : front[s];
        here = before + here * (1.0 - before.a);
        bare = bare && before.a == 0.0;
#endif
        sum += here;
    }
#ifdef CHANGED
    if (!changed) discard;
#endif
    sum /= float(rounds);
#ifdef OUTLINE
    float share = outline(gl_FragCoord.xy);
    if (bare && share == 0.0) discard; // the background was drawn already
    sum = outlined(sum, share);
#endif
    colour = encoded(sum, half_step(gl_FragCoord.xy));
}
#endif
