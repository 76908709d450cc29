// GLSL 3.30 does not read values at samples. Where one sample of a pixel may show another branch than the next, triangles
// are drawn once for each sample, with a sample mask: this tells what is there.
#include "bindings.glsl"
layout(location = kUniformSamplePosition) uniform vec2 sample_position; // from the pixel's middle, in pixels

// `values` at the sample, times something above 0: over w, values are linear in the picture.
vec3 at_sample(vec3 values) {
    vec3 over_w = values * gl_FragCoord.w;
    return over_w + sample_position.x * dFdx(over_w) + sample_position.y * dFdy(over_w);
}
