// Draws context meshes and lesions: opaque ones like vessels (geometry.frag), transparent ones as fragments in the
// lists of glass or, if there are no lists, as a layer of it (glass_output.glsl). Variants: TRANSPARENT for transparent
// shapes; LINES for the edges of triangles.

in vec3 normal_eye;
layout(location = kUniformNumber) uniform uint number; // of the mesh, from 1; with kLesionFragment of the lesion

#ifdef TRANSPARENT
#include "glass_output.glsl"
#else
layout(location = kUniformCap) uniform vec4 cap;

layout(location = 0) out uvec2 surface;
#endif

#ifdef LINES
in vec4 from_edges; // times w, which is the last; geometry.vert says why
layout(location = kUniformHalfWidth) uniform float half_width; // pixels

// The share of the pixel that a line covers. Lines become fainter where triangles are hardly wider than lines, which
// gives an even tone instead of a solid wall.
float line_share() {
    vec3 from = from_edges.xyz / from_edges.w;
    vec3 across = dFdx(from), up = dFdy(from);
    vec3 slope = max(sqrt(across * across + up * up), 1e-6); // of the share, per pixel
    vec3 away = abs(from) / slope;
    float nearest = min(away.x, min(away.y, away.z)), narrowest = 1.0 / max(slope.x, max(slope.y, slope.z));
    float crowded = clamp(narrowest / (8.0 * half_width), 0.22, 1.0); // tuned by eye
    return clamp(half_width + 0.5 - nearest, 0.0, 1.0) * min(1.0, 2.0 * half_width) * crowded;
}
#endif

void main() {
    vec3 towards_eye = gl_FrontFacing ? normal_eye : -normal_eye;
    uint normal = packSnorm2x16(octahedral(normalize(towards_eye)));
#ifdef LINES
    float share = line_share();
    add_fragment(kContextFragment | number, floatBitsToUint(share), share < 0.004 ? 0 : covered_samples());
#elif defined(TRANSPARENT)
    add_fragment(kContextFragment | number, normal, covered_samples());
#else
    bool capped = !gl_FrontFacing && cap.w > 0.5; // see caps.glsl
    if (capped) normal = packSnorm2x16(octahedral(cap.xyz));
    surface = uvec2(kSolid | kContext | number | (capped ? kCap : 0u), normal);
#endif
}
