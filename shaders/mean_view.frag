// The picture that is the mean of several views. They have noise against banding already.
#version 450 core
#include "bindings.glsl"
#include "view.glsl"
#include "look.glsl"

layout(binding = kUnitImage) uniform sampler2D sum; // linear light, premultiplied
layout(location = kUniformShare) uniform float share;      // that each view has

layout(location = 0) out vec4 colour;

void main() {
    vec4 mean = share * texelFetch(sum, ivec2(gl_FragCoord.xy), 0);
    colour = vec4(to_srgb(mean.rgb / max(mean.a, 1e-3)) * mean.a, mean.a);
}
