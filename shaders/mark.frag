// Lines over the picture, fainter where vessels hide them. Outlines of selected objects, which have a negative half
// width, are drawn only where a vessel that is not selected hides them.
#include "view.glsl"
#include "ink.glsl"

layout(binding = kUnitIdNormal) uniform usampler2D id_normal;
layout(binding = kUnitBranches) uniform usamplerBuffer branches;

in vec3 at;
flat in vec3 ink;

void main() {
    float depth = picture.w > 0.5 ? at.z : 1.0 / at.z;
    bool hidden = mm_behind(depth) > 1.5 * pixel_size(depth);
    float seen = hidden ? 0.34 : 1.0;
    if (at.y < 0.0) {
        uint id = texelFetch(id_normal, ivec2(gl_FragCoord.xy * to_inner), 0).x;
        bool of_vessel = id != 0u && (id & (kSolid | kLine)) == 0u;
        bool own = of_vessel && (texelFetch(branches, int(id) - 1).a & kSelected) != 0u;
        seen = hidden && !own ? 0.95 : 0.0;
    }
    colour = seen * inked(ink, at.x, abs(at.y), 0.55);
}
