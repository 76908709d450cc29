// Two pictures, one fading into the other in linear light; at the ends, and where they agree, they are what they are.
#version 450 core
#include "bindings.glsl"

layout(binding = kUnitImage) uniform sampler2D first; // sRGB, premultiplied
layout(binding = kUnitOtherImage) uniform sampler2D second;
layout(location = kUniformShare) uniform float share; // of the second

layout(location = 0) out vec4 colour;

vec4 to_light(vec4 c) {
    vec3 s = c.a > 0.0 ? c.rgb / c.a : vec3(0.0);
    return vec4(c.a * mix(s / 12.92, pow((s + 0.055) / 1.055, vec3(2.4)), step(vec3(0.04045), s)), c.a);
}

vec4 from_light(vec4 c) {
    vec3 l = c.a > 0.0 ? c.rgb / c.a : vec3(0.0);
    return vec4(c.a * mix(l * 12.92, 1.055 * pow(l, vec3(1.0 / 2.4)) - 0.055, step(vec3(0.0031308), l)), c.a);
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 a = texelFetch(first, at, 0), b = texelFetch(second, at, 0);
    if (share <= 0.0 || a == b)
        colour = a;
    else if (share >= 1.0)
        colour = b;
    else
        colour = from_light(mix(to_light(a), to_light(b), share));
}
