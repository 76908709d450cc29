// Conversions for full-screen passes that mix pictures: premultiplied, sRGB or linear light.
#include "look/srgb.glsl"

layout(binding = kUnitImage) uniform sampler2D image;

vec4 to_light(vec4 c) { return vec4(to_linear(c.rgb / max(c.a, 1e-3)) * c.a, c.a); }
vec4 from_light(vec4 c) { return vec4(to_srgb(c.rgb / max(c.a, 1e-3)) * c.a, c.a); }
