// Glass without lists, layer by layer: of the fragments that lie behind the last layer's, the nearest stays, sample by
// sample. See LayerPass (passes/glass_pass.h).
#version 450 core
// Variant: BORDER for triangles where branches meet, of which the samples of glass are drawn.
#include "glass_output.glsl"
#include "look/lanes.glsl"
#include "look/octahedral.glsl"

in vec3 normal_eye;
#ifdef BORDER
#include "border.glsl"
#else
flat in int branch_id;
#endif

void main() {
    vec2 slope = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));
#ifdef BORDER
    vec3 side = shares * gl_FragCoord.w; // over w they are linear, and as large beside each other
    vec3 side_x = dFdx(side), side_y = dFdy(side);
    int branch = -1; // of the samples' branches that are glass, the last: a pixel's fragment has one
    uint glass = 0u;
    for (int s = 0; s < samples; ++s) {
        int here = branch_ids[owner(side + sample_positions[s].x * side_x + sample_positions[s].y * side_y)];
        bool is_glass = layer_of(here) == 1u;
        branch = is_glass ? here : branch;
        glass |= (is_glass ? 1u : 0u) << s;
    }
#else
    int branch = branch_id;
    uint glass = (1u << samples) - 1u;
#endif
    uint before = samples_before(slope);
    if (before == 0u || glass == 0u || !behind_last_layer()) discard;
    uint masks = (before << kBeforeShift) | (glass << kGlassShift);
    fragment = uvec2(uint(branch + 1) | masks, packSnorm2x16(octahedral(normalize(normal_eye))));
    gl_FragDepth = depth_value;
}
