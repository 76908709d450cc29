// What is seen at a sample: branch id + 1 (0 is nothing) and the normal towards the eye. Light comes later, once a pixel.
#version 450 core
// Variants: BORDER for triangles where branches meet, of which the samples of opaque branches are drawn; LINE draws
// centerlines.
#include "ids.glsl"
#include "look/lanes.glsl"
#include "look/octahedral.glsl"

in vec3 normal_eye;
#ifdef BORDER
#include "border.glsl"
#ifdef FLOOR
// GLSL 3.30 does not read values at samples. Where one sample of a pixel may show another branch than the next, triangles
// are drawn once for each sample, with a sample mask: this tells what is there.
layout(location = kUniformSamplePosition) uniform vec2 sample_position; // from the pixel's middle, in pixels

// `values` at the sample, times something above 0: over w, values are linear in the picture.
vec3 at_sample(vec3 values) {
    vec3 over_w = values * gl_FragCoord.w;
    return over_w + sample_position.x * dFdx(over_w) + sample_position.y * dFdy(over_w);
}
#endif
#else
flat in int branch_id;
#endif

layout(location = 0) out uvec2 surface;

void main() {
#ifdef BORDER
#ifdef FLOOR
    int branch = branch_ids[owner(at_sample(shares))];
#else
    int branch = branch_ids[owner(interpolateAtSample(shares, gl_SampleID))];
#endif
    if (layer_of(branch) != 0u) discard;
#else
    int branch = branch_id;
#endif
    uint id = uint(branch + 1);
    vec3 normal = normalize(normal_eye);
#ifndef LINE
    if (!gl_FrontFacing) normal = vec3(0.0, 0.0, 1.0); // a lid, where glass begins
#endif
#ifdef LINE
    id |= kLine;
#endif
    surface = uvec2(id, packSnorm2x16(octahedral(normal)));
}
