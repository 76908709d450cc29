// What is seen at a sample: branch id + 1 (0 is nothing) and the normal towards the eye. Light comes later, once a pixel.
#version 450 core
// Variants: OPAQUE_SIDE cuts triangles in two where glass meets what is opaque, and the inside that shows there is drawn
// as a lid; LINE draws centerlines.
#include "ids.glsl"
#include "octahedral.glsl"

in vec3 normal_eye;
flat in int branch_id;
#ifdef OPAQUE_SIDE
in float glassy;
layout(location = 2) uniform int samples;
#ifdef FLOOR
#include "one_sample.glsl"
#endif
#endif

layout(location = 0) out uvec2 surface;

void main() {
    uint id = uint(branch_id + 1);
    vec3 normal = normalize(normal_eye);
#ifdef OPAQUE_SIDE
    if (!gl_FrontFacing) normal = vec3(0.0, 0.0, 1.0);
#ifdef FLOOR
    if (side_at_sample(glassy) > 0.0) discard;
#else
    int covered = 0;
    for (int i = 0; i < samples; ++i) covered |= (interpolateAtSample(glassy, i) > 0.0 ? 0 : 1) << i;
    gl_SampleMask[0] = covered;
#endif
#endif
#ifdef LINE
    id |= kLine;
#endif
    surface = uvec2(id, packSnorm2x16(octahedral(normal)));
}
