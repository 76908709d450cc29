// Puts slices among what was shaded without them where that is simple: a pixel shows one slice, or none. Its bytes are
// those of the picture. In other pixels it marks the depth buffer, for shade.frag with PLANES. The number of planes is
// part of the program (PLANES): software rasterisers are slow at reading numbers at an index that they do not know. DEPTHS
// if lines over the picture need depths.
#include "view.glsl"
#include "slices.glsl"

layout(binding = kUnitImage) uniform sampler2D lit_without;
#ifdef DEPTHS
layout(binding = kUnitOpaqueDepth) uniform sampler2D opaque_depth;
layout(location = kTargetSeenDepth) out float seen_depth;
#endif
layout(binding = kUnitSliceGuide) uniform sampler2D guides; // slice_guide.glsl

layout(location = kTargetColour) out vec4 colour;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 guide = texelFetch(guides, pixel, 0).xy;
    SimpleSlice slice = simple_slice_at(gl_FragCoord.xy, PLANES, guide.y);
    bool seen = slice.plane >= 0 && slice.value + slice.change >= guide.y;
    vec4 own = slice_colour(max(slice.plane, 0), slice.place, seen);
    bool mixed = slice.mixed || (seen && (slice.value - slice.change <= guide.x || own.w < 1.0));
    colour = seen ? vec4(own.rgb, 1.0) : texelFetch(lit_without, pixel, 0);
#ifdef DEPTHS
    float behind_all = texelFetch(opaque_depth, pixel, 0).x;
    seen_depth = seen ? min(behind_all, eye_depth(slice.value)) : behind_all;
#endif
    gl_FragDepth = mixed ? 1.0 : 0.0;
}
