// Reduces samples to one value per pixel: the nearest opaque surface, otherwise the nearest glass, for picking,
// outlines and occlusion. Also sorts the lists of glass. Vessels are picked through transparent context; glass in front
// of opaque context is picked. Lesions are picked as if opaque, also through glass. Variants: GLASS if anything is
// defocused or there is transparent context or lesions; CAPS if surfaces are cut open; with LESIONS the input layers are those of lesions, which go
// over the existing result (FALLBACK).
#include "view.glsl"
#ifdef GLASS
#include "glass_fragments.glsl"
#ifdef FALLBACK
layout(binding = kUnitFirstFragments) uniform usampler2DMS first_fragments; // output of fragment.frag
layout(binding = kUnitFirstDepths) uniform sampler2DMS first_depths;
layout(binding = kUnitContextDepths) uniform sampler2DMS context_depths; // of the nearest transparent shape
#endif
#endif

layout(binding = kUnitSurface) uniform usampler2DMS surface_samples;
layout(binding = kUnitDepth) uniform sampler2DMS depth_samples;
#include "caps.glsl"

layout(location = kTargetIdNormal) out uvec2 id_normal; // the normal is that of the opaque surface
layout(location = kTargetOpaqueDepth) out float opaque_depth; // for the occlusion: opaque surfaces only
layout(location = kTargetPickedDepth) out float picked_depth; // of id_normal

#if defined(GLASS) && !defined(FALLBACK)
// Fragments of equal depth may be in any order, but always the same.
bool before(GlassFragment a, GlassFragment b) {
    float da = uintBitsToFloat(a.depth), db = uintBitsToFloat(b.depth);
    if (da != db) return da > db;
    if (a.id_and_samples != b.id_and_samples) return a.id_and_samples < b.id_and_samples;
    return a.normal < b.normal;
}

// Sorts the list by insertion and returns its first fragment.
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

// Software rasterisers execute both sides of a branch: fetch only what is needed.
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int samples = int(picture.z), seen = 0;
    float nearest = 0.0, solid = 0.0; // reversed depth: larger is nearer; of all, and of all but lines
    for (int s = 0; s < samples; ++s) {
        float depth = sample_value(pixel, s);
        seen = depth > nearest ? s : seen;
        nearest = max(nearest, depth);
#ifdef GLASS
        // Lines are picked as their branch; they do not occlude what is behind them.
        bool line = (texelFetch(surface_samples, pixel, s).x & kLine) != 0u;
        solid = line ? solid : max(solid, depth);
#endif
    }
    id_normal = texelFetch(surface_samples, pixel, seen).xy;
    id_normal.x &= ~kCap;
    opaque_depth = id_normal.x == 0u ? kNothing : eye_depth(nearest);
    picked_depth = opaque_depth;
#ifdef GLASS
    opaque_depth = solid > 0.0 ? eye_depth(solid) : kNothing;
    id_normal.x &= ~kLine;
    uint vessel = 0u, lesion = 0u; // ids of the nearest fragments; 0: none
    float vessel_depth = 0.0, lesion_depth = 0.0;
#ifdef FALLBACK
    float first = 0.0, context = 0.0;
    for (int s = 0; s < samples; ++s) {
        float depth = texelFetch(first_depths, pixel, s).x;
        seen = depth > first ? s : seen;
        first = max(first, depth);
        context = max(context, texelFetch(context_depths, pixel, s).x);
    }
    bool covered = max(first, context) > 0.0;
    uint fragment = first > 0.0 ? texelFetch(first_fragments, pixel, seen).x : 0u;
#ifdef LESIONS
    if (first <= nearest) discard;
    lesion = fragment;
    lesion_depth = first;
#else
    vessel = fragment;
    vessel_depth = first;
#endif
#else
    int list = list_of(pixel);
    uint first = sorted(heads[list]);
    heads[list] = first;
    bool covered = first != 0u;
    const uint kLesion = kContextFragment | kLesionFragment;
    for (uint number = first; number != 0u; number = fragments[number].next) {
        uint id = fragments[number].id_and_samples & kIdBits;
        float depth = uintBitsToFloat(fragments[number].depth);
        if (vessel == 0u && (id & kContextFragment) == 0u) vessel = id, vessel_depth = depth;
        if (lesion == 0u && (id & kLesion) == kLesion) lesion = id, lesion_depth = depth;
    }
#endif
#ifdef CAPS
    // Fragments were tested against the depths of what is behind caps.
    if (id_normal.x != 0u && vessel_depth <= nearest) vessel = 0u;
#endif
    if (lesion_depth > nearest) {
        id_normal.x = kSolid | (lesion & kNumberBits);
        picked_depth = eye_depth(lesion_depth);
    } else if (vessel != 0u && (id_normal.x == 0u || (id_normal.x & kContext) != 0u)) {
        id_normal.x = vessel & kIdBits;
        picked_depth = eye_depth(vessel_depth);
    }
    // Pixels with only glass count as covered, so that full-screen passes do not skip them.
    if (covered) nearest = max(nearest, 1e-30);
#endif
    gl_FragDepth = nearest;
}
