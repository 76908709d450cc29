// One of the views that a fine picture is the mean of, in linear light: the target adds it to those before.
#version 450 core
#include "bindings.glsl"
#include "view.glsl"
#include "look.glsl"

layout(binding = kUnitImage) uniform sampler2D view; // sRGB, premultiplied

layout(location = 0) out vec4 light;

void main() {
    vec4 seen = texelFetch(view, ivec2(gl_FragCoord.xy), 0);
    light = vec4(to_linear(seen.rgb / max(seen.a, 1e-3)) * seen.a, seen.a);
}
