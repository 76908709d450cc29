// What is seen at a sample: branch id + 1 (0 is nothing) and the normal towards the eye. Light comes later, once a pixel.
#version 450 core
// Variants: CAPPED draws the inside of a surface as a lid, LINE draws centerlines.
#include "ids.glsl"

in vec3 normal_eye;
flat in int branch_id;

layout(location = 0) out uvec2 surface;

vec2 octahedral(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return n.z < 0.0 ? folded : p;
}

void main() {
    uint id = uint(branch_id + 1);
    vec3 normal = normalize(normal_eye);
#ifdef CAPPED
    if (!gl_FrontFacing) normal = vec3(0.0, 0.0, 1.0);
#endif
#ifdef LINE
    id |= kLine;
#endif
    surface = uvec2(id, packSnorm2x16(octahedral(normal)));
}
