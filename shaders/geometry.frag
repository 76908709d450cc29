// What is seen at a sample: branch id + 1 (0 is nothing) and the normal towards the eye. Light comes later, once a pixel.
#version 450 core
// Variants: OPAQUE_SIDE and GLASS_SIDE cut triangles in two where glass meets what is opaque, and the inside that shows
// there is drawn as a lid; LINE draws centerlines.
#include "ids.glsl"

in vec3 normal_eye;
flat in int branch_id;
#if defined(OPAQUE_SIDE) || defined(GLASS_SIDE)
in float glassy;
layout(location = 2) uniform int samples;
#endif

layout(location = 0) out uvec2 surface;

vec2 octahedral(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return n.z < 0.0 ? folded : p;
}

void main() {
    uint id = uint(branch_id + 1);
    vec3 normal = normalize(normal_eye);
#if defined(OPAQUE_SIDE) || defined(GLASS_SIDE)
    int covered = 0;
    for (int i = 0; i < samples; ++i) covered |= (interpolateAtSample(glassy, i) > 0.0 ? 1 : 0) << i;
#ifdef OPAQUE_SIDE
    covered = ~covered;
    if (!gl_FrontFacing) normal = vec3(0.0, 0.0, 1.0);
#endif
    gl_SampleMask[0] = covered;
#endif
#ifdef LINE
    id |= kLine;
#endif
    surface = uvec2(id, packSnorm2x16(octahedral(normal)));
}
