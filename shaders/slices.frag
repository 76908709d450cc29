// Puts slices among what was shaded without them where that is simple: a pixel shows one slice, or none. Its bytes are
// those of the picture. In other pixels it marks the depth buffer, for shade.frag with PLANES. The number of planes is
// part of the program (PLANES): software rasterisers are slow at reading numbers at an index that they do not know.
#include "view.glsl"
#include "slices.glsl"

layout(binding = kUnitImage) uniform sampler2D lit_without;
layout(binding = kUnitOpaqueDepth) uniform sampler2D opaque_depth;
layout(binding = kUnitSliceGuide) uniform sampler2D guides; // slice_guide.glsl

layout(location = kTargetColour) out vec4 colour;
layout(location = kTargetSeenDepth) out float seen_depth;

const float kSampleReach = 0.75; // pixels from the middle: samples are nearer

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 middle = gl_FragCoord.xy, in_first_view = middle - vec2(plane_counts.y, plane_counts.z);
    vec2 guide = texelFetch(guides, pixel, 0).xy;
    bool mixed = false;
    float nearest = kNoSlice, margin = 0.0; // of the slices that cover the pixel
    int plane = -1;
    SlicePlace place = SlicePlace(vec2(0.0), vec2(0.0), vec2(0.0), vec2(0.0));
    for (int i = 0; i < PLANES; ++i) {
        vec4 values = plane_row(i, 3), first = plane_row(i, 12);
        float inside = min(min(at_pixel(first, middle), at_pixel(plane_row(i, 13), middle)),
                           min(at_pixel(plane_row(i, 14), middle), at_pixel(plane_row(i, 15), middle)));
        float value = at_pixel(values, middle), weight = at_pixel(plane_row(i, 2), middle);
        bool near = in_box(i, middle), before = value + first.w >= guide.y;
        bool covers = near && inside > kSampleReach && weight > 0.0 && plane_row(i, 0).w > 0.0;
        // The outline has the depth of its edge, which may be nearer.
        bool at_edge = near && !covers && inside > -(values.w + 1.0) && (before || values.w > 0.0);
        mixed = mixed || at_edge || (covers && before && plane >= 0 && abs(value - nearest) <= margin + first.w);
        bool nearer = covers && value > nearest;
        SlicePlace here = slice_place(i, in_first_view);
        plane = nearer ? i : plane;
        nearest = nearer ? value : nearest;
        margin = nearer ? first.w : margin;
        place.at = nearer ? here.at : place.at;
        place.right = nearer ? here.right : place.right;
        place.up = nearer ? here.up : place.up;
        place.size = nearer ? here.size : place.size;
    }
    bool seen = plane >= 0 && nearest + margin >= guide.y;
    vec4 slice = slice_colour(max(plane, 0), place, seen);
    mixed = mixed || (seen && (nearest - margin <= guide.x || slice.w < 1.0));
    float behind_all = texelFetch(opaque_depth, pixel, 0).x;
    colour = seen ? vec4(slice.rgb, 1.0) : texelFetch(lit_without, pixel, 0);
    seen_depth = seen ? min(behind_all, eye_depth(nearest)) : behind_all;
    gl_FragDepth = mixed ? 1.0 : 0.0;
}
