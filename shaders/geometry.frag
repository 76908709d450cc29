// Outputs the visible surface at a sample: branch id + 1 (0: nothing) and the normal towards the eye. Shading is a
// later pass, once per pixel. Variants: BORDER for triangles where branches meet, of which samples of opaque branches
// are drawn; LINE for centerlines; VALUE for surfaces with a value per vertex.

in vec3 normal_eye;
#ifndef LINE
layout(location = kUniformInside) uniform int inside;
layout(location = kUniformCap) uniform vec4 cap;
#endif
#ifdef BORDER
#include "border.glsl"
#ifdef FALLBACK
// Triangles that may show several branches within a pixel are drawn once per sample, with a sample mask: this is the
// sample's position.
layout(location = kUniformSamplePosition) uniform vec2 sample_position; // from the pixel's middle, in pixels
#endif
#else
flat in int branch_id;
#endif

layout(location = kTargetSurface) out uvec2 surface;
#ifdef VALUE
centroid in float value_here; // centroid: no extrapolation beyond the triangle
layout(location = kTargetValue) out float value;
#endif

void main() {
#ifdef BORDER
#ifdef FALLBACK
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
    // From inside a vessel its wall is visible; where glass begins, back faces look like a lid; where the vessel is cut,
    // they stand for the cap (caps.glsl).
    if (!gl_FrontFacing) {
        normal = cap.w > 0.5 ? cap.xyz : inside != 0 ? -normal : vec3(0.0, 0.0, 1.0);
        id |= cap.w > 0.5 ? kCap : 0u;
    }
#endif
    surface = uvec2(id, packSnorm2x16(octahedral(normal)));
#ifdef VALUE
    value = value_here;
#endif
}
