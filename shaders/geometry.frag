// What is seen at a sample: branch id + 1 (0 is nothing) and the normal towards the eye. Light comes later, once a pixel.
// Variants: BORDER for triangles where branches meet, of which the samples of opaque branches are drawn; LINE draws
// centerlines; VALUE for surfaces with a value for each vertex.

in vec3 normal_eye;
#ifndef LINE
layout(location = kUniformInside) uniform int inside;
#endif
#ifdef BORDER
#include "border.glsl"
#ifdef FLOOR
// Where one sample of a pixel may show another branch than the next, triangles are drawn once for each sample, with a
// sample mask: this tells what is there.
layout(location = kUniformSamplePosition) uniform vec2 sample_position; // from the pixel's middle, in pixels
#endif
#else
flat in int branch_id;
#endif

layout(location = kTargetSurface) out uvec2 surface;
#ifdef VALUE
centroid in float value_here; // beyond a triangle's edge it would be one that no vertex has
layout(location = kTargetValue) out float value;
#endif

void main() {
#ifdef BORDER
#ifdef FLOOR
    int branch = branch_ids[owner(shares_at(sample_position))];
#else
    int branch = branch_ids[owner(interpolateAtSample(shares, gl_SampleID))];
#endif
    if (layer_of(branch) != 0u) discard;
#else
    int branch = branch_id;
#endif
    uint id = uint(branch + 1);
    vec3 normal = normalize(normal_eye);
#ifdef LINE
    id |= kLine;
#else
    // The wall from within, or a lid, where glass begins.
    if (!gl_FrontFacing) normal = inside != 0 ? -normal : vec3(0.0, 0.0, 1.0);
#endif
    surface = uvec2(id, packSnorm2x16(octahedral(normal)));
#ifdef VALUE
    value = value_here;
#endif
}
