// Light, states and background: samples to the picture's colours. All light is reckoned in linear light; the result is
// sRGB with premultiplied alpha.
#version 450 core
// Variants: GLASS when anything is defocused, OUTLINE when anything is selected, MARGINS to colour by how far lesions are,
// SCALE to colour by a value along the branches, CUTS when any branch is cut or lost, CHANGED to shade what is marked so
// and leave the rest of the last picture, HALOS, CONTOURS and CHROMADEPTH for what tells near from far, CONTEXT when
// there are context meshes or lesions. LAYER lays one layer of glass onto those before it, where there are no lists
// (FLOOR).
#include "bindings.glsl"
#include "view.glsl"
#include "ids.glsl"
#include "look.glsl"
#include "scene.glsl"

layout(binding = kUnitSurface) uniform usampler2DMS surface_samples;
layout(binding = kUnitDepth) uniform sampler2DMS depth_samples;
layout(binding = kUnitOpaqueDepth) uniform sampler2D opaque_depth;
layout(binding = kUnitIdNormal) uniform usampler2D id_normal;
layout(binding = kUnitOcclusion) uniform sampler2D occlusion;
layout(binding = kUnitBranches) uniform usamplerBuffer branches; // linear colour of 65535, and in alpha the flags of ids.glsl

#ifdef GLASS
#include "glass_fragments.glsl"
#ifdef FLOOR
layout(binding = kUnitFronts) uniform sampler2DArray fronts_of_samples; // what glass_layer.glsl made of the glass, a layer a sample
layout(binding = kUnitOpaqueSamples) uniform sampler2DMS opaque_samples;
#else
layout(location = kUniformBand) uniform ivec2 pixels; // width and first row of the band that the lists are for
#endif
#endif

#ifndef LAYER
layout(location = 0) out vec4 colour;
#endif

struct Light {
    float diffuse;
    float specular;
};

Light lit(vec3 n, vec3 v, vec3 towards, float wrap) {
    Light light;
    light.diffuse = max(0.0, (dot(n, towards) + wrap) / (1.0 + wrap));
    light.specular = max(0.0, dot(n, normalize(towards + v))); // to a power: see below
    return light;
}

// Whole powers by multiplication: a software rasteriser takes ten times as long for pow().
float to_8(float x) {
    float x2 = x * x, x4 = x2 * x2;
    return x4 * x4;
}
float to_24(float x) {
    float x8 = to_8(x);
    return x8 * x8 * x8;
}
float to_60(float x) {
    float x4 = x * x * x * x, x20 = x4 * x4 * x4 * x4 * x4;
    return x20 * x20 * x20;
}
float to_70(float x) {
    float x8 = to_8(x), x2 = x * x, x32 = x8 * x8 * x8 * x8;
    return x32 * x32 * x2 * x2 * x2;
}

// Lights are fixed to the viewer's head: a warm key from the upper left, a cool fill from the right, a rim of sky.
const vec3 kKey = vec3(-0.429, 0.572, 0.699);
const vec3 kFill = vec3(0.772, -0.051, 0.634);

#ifdef CONTEXT
#include "context.glsl"
#endif

#ifdef CUTS
// What is lost is dark and hatched; a clean ring ends it at the cut.
vec3 lost(vec3 albedo, uint flags, int branch, vec3 position) {
    float pixel_mm = pixel_to_eye.z * (picture.w > 0.5 ? 1.0 : position.z);
    float behind = (flags & kLost) != 0u ? 1e30 : -1e30;
    if ((flags & kCut) != 0u) behind = max(behind, behind_cut(branch, position));
    float across = fract((gl_FragCoord.x + gl_FragCoord.y) / (9.0 * more.z));
    float stripe = smoothstep(0.0, 0.16, across) * (1.0 - smoothstep(0.34, 0.5, across));
    vec3 hatched = lost_colour.rgb * mix(0.50, 1.35, stripe);
    vec3 found = mix(albedo, hatched, clamp(behind / pixel_mm + 0.5, 0.0, 1.0));
    return mix(vec3(0.92), found, smoothstep(0.8, 1.6, abs(behind) / (pixel_mm * more.z)));
}
#endif

#ifdef CHROMADEPTH
// Red comes forward and blue goes back: in the eye, by its lens, and by habit. Linear, about equally bright.
vec3 chromatic(float far) {
    vec3 near_red = vec3(0.78, 0.045, 0.03), violet = vec3(0.42, 0.05, 0.36), far_blue = vec3(0.035, 0.11, 0.72);
    return far < 0.5 ? mix(near_red, violet, 2.0 * far) : mix(violet, far_blue, 2.0 * far - 1.0);
}
#endif

#ifdef HALOS
// How much of the ring around a pixel shows something nearer, the more the farther behind it the pixel lies: the seam
// that a vessel leaves on what it passes (Bruckner and Groeller, 2007, have it for volumes).
float halo(ivec2 pixel, float depth) {
    ivec2 last = ivec2(picture.xy) - 1;
    float least = 0.006 * (depth_range.y - depth_range.x), most = 12.0 * least, sum = 0.0;
    for (int i = 0; i < 12; ++i) {
        float angle = 0.5235988 * (float(i) + 0.5), reach = cues.w * ((i & 1) == 0 ? 1.0 : 0.55);
        ivec2 tap = clamp(pixel + ivec2(round(reach * vec2(cos(angle), sin(angle)))), ivec2(0), last);
        float before = depth - texelFetch(opaque_depth, tap, 0).x;
        sum += clamp((before - least) / (most - least), 0.0, 1.0) * (before > 1e20 ? 0.0 : 1.0);
    }
    return clamp(sum / 3.0, 0.0, 1.0);
}
#endif

#ifdef SHADOWS
// How much of the key light what the picture shows takes from a place: steps towards the light, shorter ones first, and
// asks whether something lies before them, but not far before.
float shadowed(vec3 position, vec3 n) {
    float reach = 2.2 * depth_range.w * (picture.w > 0.5 ? 1.0 : position.z), least = 0.012 * reach, hidden = 0.0;
    vec3 start = position + least * vec3(n.xy, -n.z), way = reach * vec3(kKey.xy, -kKey.z);
    ivec2 last = ivec2(picture.xy) - 1;
    for (int i = 1; i <= 30; ++i) {
        float t = float(i) / 30.0;
        t *= 0.3 + 0.7 * t;
        vec3 at = start + t * way;
        vec2 pixel = at.xy / (pixel_to_eye.z * (picture.w > 0.5 ? 1.0 : at.z)) + pixel_to_eye.xy;
        float before = at.z - texelFetch(opaque_depth, clamp(ivec2(floor(pixel)), ivec2(0), last), 0).x;
        float inside = clamp((before - least) / (2.0 * least + 0.12 * t * reach), 0.0, 1.0);
        hidden = max(hidden, inside * clamp(2.0 - 2.0 * before / reach, 0.0, 1.0) * (1.0 - t));
    }
    return hidden;
}
#endif

vec3 shade(uint id, vec3 n, vec3 position, float occluded) {
    vec3 v = picture.w > 0.5 ? vec3(0.0, 0.0, 1.0) : normalize(vec3(-position.xy, position.z));
#ifdef CONTEXT
    uint own = id;
    bool is_context = (own & kContext) != 0u;
    id = is_context ? 1u : id;
#endif
    uvec4 branch = texelFetch(branches, int(id) - 1);
    vec3 albedo = vec3(branch.rgb) / 65535.0;
#ifdef SCALE
    if ((branch.a & kHighlighted) == 0u) albedo = colour_on_scale(int(id) - 1, position, albedo);
#endif
#ifdef MARGINS
    if ((branch.a & kHighlighted) == 0u) albedo = margin_colour(position);
#endif
#ifdef CUTS
    if ((branch.a & (kLost | kCut)) != 0u) albedo = lost(albedo, branch.a, int(id) - 1, position);
#endif
#ifdef CONTEXT
    if (is_context) branch.a = 0u, albedo = context_mesh(own).rgb;
#endif
    float facing = clamp(dot(n, v), 0.0, 1.0);
    float far = clamp((position.z - depth_range.x) / (depth_range.y - depth_range.x), 0.0, 1.0);
#ifdef CHROMADEPTH
    vec3 own_colour = albedo;
    if ((branch.a & kHighlighted) == 0u) albedo = mix(albedo, chromatic(far), cues.z);
#ifdef CONTEXT
    if (is_context) albedo = own_colour; // as it was chosen
#endif
#endif
    if ((branch.a & kSelected) != 0u) albedo = mix(albedo, selection_colour.rgb, 0.62);
    if ((branch.a & kCalm) != 0u) albedo = mix(vec3(dot(albedo, vec3(0.2126, 0.7152, 0.0722))), albedo, 0.38) * 0.62;

    float open = 1.0 - more.x * occluded;
    Light key = lit(n, v, kKey, 0.06), fill = lit(n, v, kFill, 0.30);
    vec3 ambient = mix(vec3(0.085, 0.070, 0.074), vec3(0.190, 0.205, 0.240), 0.5 + 0.5 * n.y);
    float shadow = mix(1.0, open, 0.75); // the key is soft: what takes the sky takes some of it as well
#ifdef SHADOWS
    float lit_share = 1.0 - 0.85 * more.w * shadowed(position, n);
    shadow *= lit_share;
    fill.diffuse *= 0.55 + 0.45 * lit_share;
#endif
    vec3 radiance = albedo * (1.50 * lights.x * key.diffuse * vec3(1.0, 0.965, 0.915) * shadow +
                              0.34 * lights.y * fill.diffuse * vec3(0.80, 0.90, 1.0) * open + ambient * open * open);
    radiance += lights.w * shadow * (0.25 * to_70(key.specular) * vec3(1.0, 0.98, 0.95) + 0.03 * to_24(fill.specular));
    float aside = 1.0 - facing;
    radiance += lights.z * aside * aside * aside * open * (0.14 * albedo + 0.020 * vec3(0.75, 0.87, 1.0)) * (0.6 + 0.4 * n.y);
    if ((branch.a & kHighlighted) != 0u) radiance = radiance * 1.10 + 0.05 * albedo;

#ifdef CONTOURS
    radiance *= 1.0 - cues.y * 0.85 * (1.0 - smoothstep(0.12, 0.42, facing));
#endif
    float cue = background_bottom.w * ((branch.a & kHighlighted) != 0u ? 0.25 : 0.68) * far * sqrt(far);
    radiance = mix(radiance, far_colour.rgb, cue);
    if ((branch.a & kHovered) != 0u) radiance += (0.10 + 0.55 * aside * aside) * mix(albedo, vec3(0.8), 0.55);
    if ((branch.a & kGlowing) != 0u) radiance += (0.03 + 0.30 * aside * aside) * mix(albedo, vec3(0.8), 0.35);
    return radiance;
}

#ifdef GLASS
// Centerlines are plain: no light, only the tree's depth.
vec3 line(uint id, vec3 position) {
    uint flags = texelFetch(branches, int(id) - 1).a;
    vec3 radiance = line_colour.rgb;
    if ((flags & kSelected) != 0u) radiance = mix(radiance, selection_colour.rgb, 0.8);
    if ((flags & kHovered) != 0u) radiance = mix(radiance, vec3(1.0, 0.85, 0.55), 0.6);
    if ((flags & kLost) != 0u) radiance = mix(radiance, lost_colour.rgb, 0.6);
    float far = clamp((position.z - depth_range.x) / (depth_range.y - depth_range.x), 0.0, 1.0);
    return mix(radiance, far_colour.rgb, 0.62 * background_bottom.w * far);
}

// Clear grey glass: nearly nothing where it faces the eye, a veil towards its outline.
vec4 glass(uint id, vec3 n, vec3 position) {
    vec3 v = picture.w > 0.5 ? vec3(0.0, 0.0, 1.0) : normalize(vec3(-position.xy, position.z));
    uvec4 branch = texelFetch(branches, int(id) - 1);
    float facing = clamp(dot(n, v), 0.0, 1.0);
    float veil = mix(0.16, 0.72, pow(1.0 - facing, 1.6));
    vec3 tint = glass_colour.rgb;
    if ((branch.a & kSelected) != 0u) tint = mix(tint, selection_colour.rgb, 0.7), veil += 0.12;
    if ((branch.a & kHovered) != 0u) tint *= 1.6, veil += 0.12;
    if ((branch.a & kGlowing) != 0u) tint *= 1.3, veil += 0.06;
#ifdef CUTS
    if ((branch.a & kLost) != 0u) tint = mix(tint, 1.4 * lost_colour.rgb, 0.7);
#endif
    float opacity = more.y;
    veil = opacity < 1.0 ? veil * opacity : mix(veil, 0.97, opacity - 1.0);
    vec3 radiance = tint * (0.55 + 0.85 * max(0.0, dot(n, kKey)));
    float shine = min(opacity, 1.0) * lights.w * 0.40 * to_60(max(0.0, dot(n, normalize(kKey + v))));
    float far = clamp((position.z - depth_range.x) / (depth_range.y - depth_range.x), 0.0, 1.0);
    veil *= 1.0 - 0.5 * background_bottom.w * far;
    return vec4(radiance * veil + shine, clamp(veil + shine, 0.0, 1.0));
}

// Of a fragment as the lists and layers have it.
vec4 veil_of(uint id, uint normal, vec3 position) {
#ifdef CONTEXT
    if ((id & kContextFragment) != 0u) return context_veil(id, normal, position);
#endif
    return glass(id & kIdBits, unpack_normal(normal), position);
}
#endif

#ifdef CHANGED
bool has_changed(uint id) {
    return id != 0u && (id & kSolid) == 0u && (texelFetch(branches, int(id & ~kLine) - 1).a & kChanged) != 0u;
}
#endif

#ifdef OUTLINE
bool selected(uint id) {
    return id != 0u && (id & kSolid) == 0u && (texelFetch(branches, int(id) - 1).a & kSelected) != 0u;
}

// Share of the ring around the pixel that differs from it in being selected.
float outline(ivec2 pixel) {
    ivec2 last = ivec2(picture.xy) - 1;
    uint own = texelFetch(id_normal, pixel, 0).x;
    bool inside = selected(own);
    float differing = 0.0;
    for (int i = 0; i < 12; ++i) {
        float angle = 0.5235988 * (float(i) + 0.5);
        ivec2 tap = clamp(pixel + ivec2(round(selection_colour.w * vec2(cos(angle), sin(angle)))), ivec2(0), last);
        uint id = texelFetch(id_normal, tap, 0).x;
        differing += selected(id) != inside ? 1.0 : 0.0;
    }
    return smoothstep(0.0, 3.0, differing);
}
#endif

#ifdef LAYER
#include "glass_layer.glsl"
#else
// Software rasterisers execute both sides of a branch, but leave a loop early: pixels inside one surface go round once,
// pixels on an edge once a sample.
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int samples = int(picture.z);
#if defined(GLASS) && !defined(FLOOR)
    int index = (pixel.y - pixels.y) * pixels.x + pixel.x;
#endif
#ifdef CHANGED
    // Pixels without a sample of what changed go round no loop below, and stay as they are.
    bool changed = false;
    for (int s = 0; s < samples; ++s) changed = changed || has_changed(texelFetch(surface_samples, pixel, s).x);
#if defined(GLASS) && !defined(FLOOR)
    for (uint number = heads[index]; number != 0u && !changed; number = fragments[number].next)
        changed = (fragments[number].id_and_samples & kContextFragment) == 0u &&
                  has_changed(fragments[number].id_and_samples & kIdBits);
#endif
    samples = changed ? samples : 0;
#endif
    vec4 behind = background_top.w > 0.5 ? vec4(0.0) : vec4(to_linear(background(gl_FragCoord.xy)), 1.0);
    float occluded = texelFetch(occlusion, pixel, 0).x;

    uvec2 first = texelFetch(surface_samples, pixel, 0).xy;
    bool whole = first.x != 0u;
    vec3 first_normal = unpack_normal(first.y), mean_normal = first_normal;
    float first_depth = texelFetch(depth_samples, pixel, 0).x, mean_depth = first_depth;
    for (int s = 1; s < samples; ++s) {
        uvec2 found = texelFetch(surface_samples, pixel, s).xy;
        vec3 normal = unpack_normal(found.y);
        whole = whole && found.x == first.x && dot(normal, first_normal) > 0.7;
        mean_normal += normal;
        mean_depth += texelFetch(depth_samples, pixel, s).x;
    }
    mean_depth /= float(samples);

#ifdef GLASS
    // Front to back, each sample by itself: a fragment veils what lies behind it. Its light is reckoned once for all of them.
    float opaque_values[kMostSamples];
    vec4 front[kMostSamples]; // premultiplied
    bool empty = true;
    for (int s = 0; s < kMostSamples; ++s) {
        opaque_values[s] = s < samples ? texelFetch(depth_samples, pixel, s).x : 0.0;
        front[s] = vec4(0.0);
        empty = empty && opaque_values[s] == 0.0;
    }
#ifdef FLOOR
    for (int s = 0; s < kMostSamples; ++s) front[s] = texelFetch(fronts_of_samples, ivec3(pixel, s), 0);
#else
    float clear = 1.0;
    for (uint number = heads[index]; number != 0u && clear > 1e-3;) {
        GlassFragment fragment = fragments[number];
        float value = uintBitsToFloat(fragment.depth);
        vec4 veil = veil_of(fragment.id_and_samples, fragment.normal, eye_position(gl_FragCoord.xy, eye_depth(value)));
        clear = 0.0;
        for (int s = 0; s < kMostSamples; ++s) {
            bool hit = ((fragment.id_and_samples >> (kSampleShift + s)) & 1u) != 0u && value > opaque_values[s];
            front[s] += hit ? (1.0 - front[s].a) * veil : vec4(0.0);
            clear = max(clear, 1.0 - front[s].a);
        }
        number = fragment.next;
    }
#endif
    vec4 mean_front = vec4(0.0);
    for (int s = 0; s < kMostSamples; ++s) mean_front += s < samples ? front[s] : vec4(0.0);
    mean_front /= float(max(samples, 1));
    whole = whole || empty; // nothing but glass: what lies behind is the same for all samples
#endif

    vec4 sum = vec4(0.0);
    int rounds = samples == 0 ? 0 : whole ? 1 : samples;
    for (int s = 0; s < rounds; ++s) {
        uvec2 found = texelFetch(surface_samples, pixel, s).xy;
        float value = whole ? mean_depth : texelFetch(depth_samples, pixel, s).x;
        vec3 normal = whole ? normalize(mean_normal) : unpack_normal(found.y);
        vec3 position = eye_position(gl_FragCoord.xy, eye_depth(value));
#ifdef GLASS
        bool is_line = (found.x & kLine) != 0u;
        found.x &= ~kLine;
#endif
        vec4 here = vec4(shade(max(found.x, 1u), normal, position, occluded), 1.0);
#ifdef HALOS
        here.rgb *= 1.0 - 0.9 * cues.x * halo(pixel, position.z);
#endif
        if (found.x == 0u) here = behind;
#ifdef GLASS
        if (is_line) here.rgb = line(found.x, position);
        vec4 before = whole ? mean_front : front[s];
        here = before + here * (1.0 - before.a);
#endif
        sum += here;
    }
#ifdef CHANGED
    if (!changed) discard;
#endif
    sum /= float(rounds);
#ifdef OUTLINE
    sum = mix(sum, vec4(selection_colour.rgb, 1.0), 0.85 * outline(pixel));
#endif
    colour = encoded(sum, gl_FragCoord.xy);
}
#endif
