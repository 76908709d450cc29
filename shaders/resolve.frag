// One value a pixel from the samples: the nearest opaque surface, else the nearest glass. Picking, outlines and the
// occlusion read this. The lists of glass are put in order on the way. Clear context is seen through, and glass in
// front of opaque context is pointed at: that has no branch. Lesions are pointed at as if they were opaque, also through
// glass.
#version 450 core
// Variants: GLASS when anything is defocused or context is clear or there are lesions; with LESIONS the layers below are
// those of lesions, which go over what was there (FLOOR).
#include "bindings.glsl"
#include "view.glsl"
#include "ids.glsl"
#ifdef GLASS
#include "glass_fragments.glsl"
#ifdef FLOOR
layout(binding = kUnitFirstFragments) uniform usampler2DMS first_fragments; // as fragment_layer.frag leaves them
layout(binding = kUnitFirstDepths) uniform sampler2DMS first_depths;
layout(binding = kUnitContextDepths) uniform sampler2DMS context_depths; // of the nearest that is clear and no vessel
#else
layout(location = kUniformBand) uniform ivec2 pixels; // width and first row of the band that the lists are for
#endif
#endif

layout(binding = kUnitSurface) uniform usampler2DMS surface_samples;
layout(binding = kUnitDepth) uniform sampler2DMS depth_samples;

layout(location = kTargetIdNormal) out uvec2 id_normal; // the normal is the opaque surface's
layout(location = kTargetOpaqueDepth) out float opaque_depth; // for the occlusion: opaque surfaces only
layout(location = kTargetPickedDepth) out float picked_depth; // of id_normal

#if defined(GLASS) && !defined(FLOOR)
// Any order will do where depths are the same, if only it is always the same one.
bool before(GlassFragment a, GlassFragment b) {
    float da = uintBitsToFloat(a.depth), db = uintBitsToFloat(b.depth);
    if (da != db) return da > db;
    if (a.id_and_samples != b.id_and_samples) return a.id_and_samples < b.id_and_samples;
    return a.normal < b.normal;
}

// The first fragment of the list, sorted by insertion.
uint sorted(uint head) {
    uint first = 0u;
    while (head != 0u) {
        GlassFragment fragment = fragments[head];
        uint previous = 0u, after = first;
        while (after != 0u) {
            GlassFragment other = fragments[after];
            if (before(fragment, other)) break;
            previous = after;
            after = other.next;
        }
        fragments[head].next = after;
        if (previous == 0u)
            first = head;
        else
            fragments[previous].next = head;
        head = fragment.next;
    }
    return first;
}
#endif

// Software rasterisers execute both sides of a branch: fetch what is needed, not what might be.
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int samples = int(picture.z), seen = 0;
    float nearest = 0.0; // reversed depth: larger is nearer
    for (int s = 0; s < samples; ++s) {
        float depth = texelFetch(depth_samples, pixel, s).x;
        seen = depth > nearest ? s : seen;
        nearest = max(nearest, depth);
    }
    id_normal = texelFetch(surface_samples, pixel, seen).xy;
    opaque_depth = id_normal.x == 0u ? kNothing : eye_depth(nearest);
    picked_depth = opaque_depth;
#ifdef GLASS
    // Lines are picked as their branch; they take no light from what they run before.
    float solid = 0.0;
    for (int s = 0; s < samples; ++s) {
        float depth = texelFetch(depth_samples, pixel, s).x;
        bool line = (texelFetch(surface_samples, pixel, s).x & kLine) != 0u;
        solid = line ? solid : max(solid, depth);
    }
    opaque_depth = solid > 0.0 ? eye_depth(solid) : kNothing;
    id_normal.x &= ~kLine;
#ifdef FLOOR
    float first = 0.0, context = 0.0;
    for (int s = 0; s < samples; ++s) {
        float depth = texelFetch(first_depths, pixel, s).x;
        seen = depth > first ? s : seen;
        first = max(first, depth);
        context = max(context, texelFetch(context_depths, pixel, s).x);
    }
#ifdef LESIONS
    if (first <= nearest) discard;
    id_normal.x = kSolid | (texelFetch(first_fragments, pixel, seen).x & kNumberBits);
    picked_depth = eye_depth(first);
#else
    if (first > 0.0 && (id_normal.x == 0u || (id_normal.x & kContext) != 0u)) {
        id_normal.x = texelFetch(first_fragments, pixel, seen).x & kIdBits;
        picked_depth = eye_depth(first);
    }
#endif
    if (max(first, context) > 0.0) nearest = max(nearest, 1e-30);
#else
    int index = (pixel.y - pixels.y) * pixels.x + pixel.x;
    uint first = sorted(heads[index]);
    heads[index] = first;
    uint vessel = first, lesion = first;
    while (vessel != 0u && (fragments[vessel].id_and_samples & kContextFragment) != 0u) vessel = fragments[vessel].next;
    const uint kLesion = kContextFragment | kLesionFragment;
    while (lesion != 0u && (fragments[lesion].id_and_samples & kLesion) != kLesion) lesion = fragments[lesion].next;
    float lesion_depth = lesion == 0u ? 0.0 : uintBitsToFloat(fragments[lesion].depth);
    if (lesion_depth > nearest) {
        id_normal.x = kSolid | (fragments[lesion].id_and_samples & kNumberBits);
        picked_depth = eye_depth(lesion_depth);
    } else if (vessel != 0u && (id_normal.x == 0u || (id_normal.x & kContext) != 0u)) {
        id_normal.x = fragments[vessel].id_and_samples & kIdBits;
        picked_depth = eye_depth(uintBitsToFloat(fragments[vessel].depth));
    }
    // What is only covered by glass is covered: full-screen passes must not skip it.
    if (first != 0u) nearest = max(nearest, 1e-30);
#endif
#endif
    gl_FragDepth = nearest;
}
